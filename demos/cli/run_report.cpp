#include "demos/cli/run_report.h"

#include <ostream>

#include "demos/cli/progress_bar.h"
#include "demos/cli/report_json.h"
#include "demos/cli/report_tables.h"

namespace limber::demos {

RunResult run_with_progress(const SceneOptions& options, const Scene& scene, Terminal& terminal,
                            const std::function<bool()>& go_on) {
  ProgressBar bar(terminal.err);
  return run(
      scene, options.run, [&](double done) { bar.show(scene.name, done); }, go_on);
}

void report_run(const SceneOptions& options, const Scene& scene, const RunResult& result,
                Terminal& terminal) {
  for (std::size_t n = scene.notes.size(); n < result.notes.size(); ++n) {
    terminal.err << "note: " << result.notes[n] << '\n';
  }
  write_json(options, run_json(result, options.run.policy), terminal);
  if (tables_wanted(options)) terminal.out << run_report(result, options.run.policy);
  if (result.failure) throw SimulationError(*result.failure);
}

}  // namespace limber::demos
