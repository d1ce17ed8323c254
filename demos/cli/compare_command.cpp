#include "demos/cli/compare_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "core/threads/parallel_for.h"
#include "demos/cli/comparison.h"
#include "demos/cli/numbers.h"
#include "demos/cli/options.h"
#include "demos/cli/progress_bar.h"
#include "demos/cli/report_json.h"
#include "demos/cli/report_tables.h"

namespace limber::demos {
namespace {

constexpr int kMostRuns = 50;              // the smallest step is then half of the automatic one
constexpr double kSpringRateWall_s = 1.0;  // long enough to average over the scheduler

constexpr const char* kFooter =
    "Breaking is chaotic: runs that differ in the last bit break into different pieces. --noise K\n"
    "therefore repeats both methods at the automatic step times 1, 0.99, 0.98, ... The noise "
    "floor\n"
    "is the mean over all pairs i < j of the flexible runs; the error is the mean over all pairs\n"
    "of flexible run i and switching run j with i != j, because runs at the same step share their\n"
    "noise. Times are those of the pair at the automatic step; each run is timed once.";

struct CompareOptions : SceneOptions {
  int runs = 1;  // of each method
};

RunOptions run_options(const CompareOptions& options, Policy policy, int k) {
  RunOptions run = options.run;
  run.policy = policy;
  run.step_scale = step_scale(static_cast<std::size_t>(k));
  return run;
}

ComparedRuns run_all(const CompareOptions& options, const Scene& scene, Terminal& terminal) {
  ProgressBar bar(terminal.err);
  const auto one = [&](Policy policy, int k) {
    const std::string what = options.runs == 1
                                 ? name_of(policy)
                                 : fmt::format("{} {} of {}", name_of(policy), k + 1, options.runs);
    RunResult result =
        run(scene, run_options(options, policy, k), [&](double done) { bar.show(what, done); });
    if (result.failure) throw SimulationError(*result.failure);
    return result;
  };
  ComparedRuns runs;
  for (int k = 0; k < options.runs; ++k) {
    runs.flexible.push_back(one(Policy::kFlexible, k));
    runs.switching.push_back(one(Policy::kSwitching, k));
  }
  bar.show("springs alone", 0.0);
  runs.spring_rate = spring_rate(scene, runs.flexible.front().spring_precision, kSpringRateWall_s);
  return runs;
}

void compare_scene(const CompareOptions& options, Terminal& terminal) {
  const Scene scene = scene_of(options, terminal);
  require_other_file(options.scene, options.json);
  require_json_target(options);
  say_notes(scene.notes, terminal);
  set_threads(options.threads);
  const ComparedRuns runs = run_all(options, scene, terminal);
  const Comparison comparison = compare(runs);
  write_json(options, comparison_json(runs, comparison), terminal);
  if (tables_wanted(options)) terminal.out << comparison_report(runs, comparison);
}

void add_noise(CLI::App& command, CompareOptions& options) {
  command
      .add_option_function<std::string>(
          "--noise",
          [&](const std::string& text) {
            options.runs = parse_whole(text, 2, kMostRuns, "--noise");
          },
          "run both methods at K slightly different steps and measure the noise floor")
      ->type_name("K");
}

}  // namespace

void add_compare_command(CLI::App& app, Action& chosen) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
      app.add_subcommand("compare", "Run a scene all-flexible and switching: speed-up and errors");
  add_scene(*command, *options, true);
  add_seconds(*command, *options);
  add_tick(*command, *options);
  add_noise(*command, *options);
  add_springs(*command, *options);
  add_threads(*command, *options);
  add_json(*command, *options);
  add_set(*command, *options);
  add_inputs(*command, *options);
  command->footer(kFooter);
  command->callback([options, &chosen] {
    chosen = [options](Terminal& terminal) { compare_scene(*options, terminal); };
  });
}

}  // namespace limber::demos
