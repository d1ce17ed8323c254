#include "demos/cli/run_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <ostream>

#include "core/model/errors.h"
#include "core/threads/parallel_for.h"
#include "demos/cli/options.h"
#include "demos/cli/progress_bar.h"
#include "demos/cli/report_json.h"
#include "demos/cli/report_tables.h"

namespace limber::demos {
namespace {

RunResult run_with_progress(const SceneOptions& options, const Scene& scene, Terminal& terminal) {
  ProgressBar bar(terminal.err);
  return run(scene, options.run, [&](double done) { bar.show(scene.name, done); });
}

void run_scene(const SceneOptions& options, Terminal& terminal) {
  const Scene scene = scene_of(options, terminal);
  require_other_file(options.scene, options.json);
  require_json_target(options);
  say_notes(scene.notes, terminal);
  set_threads(options.threads);
  const RunResult result = run_with_progress(options, scene, terminal);
  for (std::size_t n = scene.notes.size(); n < result.notes.size(); ++n) {
    terminal.err << "note: " << result.notes[n] << '\n';
  }
  write_json(options, run_json(result, options.run.policy), terminal);
  if (tables_wanted(options)) terminal.out << run_report(result, options.run.policy);
  if (result.failure) throw SimulationError(*result.failure);
}

void list_scenes(Terminal& terminal) { terminal.out << scene_list(scene_library()); }

// `limber run --seconds 2` is a forgotten scene, not the wish to see the list.
void refuse_options_without_scene(const CLI::App& command) {
  const auto options = command.get_options();
  const bool any = std::any_of(options.begin(), options.end(),
                               [](const CLI::Option* option) { return option->count() > 0; });
  if (!any) return;
  throw InputError({"command line", "SCENE is missing", "`limber run` alone lists the scenes"});
}

}  // namespace

void add_run_command(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<SceneOptions>();
  CLI::App* command = app.add_subcommand(
      "run", "Simulate a scene and report what happened; without SCENE, list the scenes");
  add_scene(*command, *options, false);
  add_seconds(*command, *options);
  add_policy(*command, *options);
  add_tick(*command, *options);
  add_integrator(*command, *options);
  add_springs(*command, *options);
  add_threads(*command, *options);
  add_json(*command, *options);
  add_set(*command, *options);
  add_inputs(*command, *options);
  command->callback([command, options, &chosen] {
    if (options->scene.empty()) {
      refuse_options_without_scene(*command);
      chosen = list_scenes;
    } else {
      chosen = [options](Terminal& terminal) { run_scene(*options, terminal); };
    }
  });
}

}  // namespace limber::demos
