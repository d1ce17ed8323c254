#include "demos/cli/run_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <ostream>

#include "core/model/errors.h"
#include "core/threads/parallel_for.h"
#include "demos/cli/options.h"
#include "demos/cli/report_tables.h"
#include "demos/cli/run_report.h"
#include "demos/cli/watch.h"

namespace limber::demos {
namespace {

void prepare(const SceneOptions& options) {
  require_other_file(options.scene, options.json);
  require_json_target(options);
  set_threads(options.threads);
}

void run_scene(const SceneOptions& options, Terminal& terminal) {
  const Scene scene = scene_of(options, terminal);
  prepare(options);
  say_notes(scene.notes, terminal);
  report_run(options, scene, run_with_progress(options, scene, terminal), terminal);
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
  auto watch = std::make_shared<bool>(false);
  command->add_flag("--watch", *watch,
                    "run again whenever a file of the scene is saved, until Ctrl-C");
  command->callback([command, options, watch, &chosen] {
    if (options->scene.empty()) {
      refuse_options_without_scene(*command);
      chosen = list_scenes;
    } else if (*watch) {
      chosen = [options](Terminal& terminal) {
        prepare(*options);
        watch_scene(*options, terminal);
      };
    } else {
      chosen = [options](Terminal& terminal) { run_scene(*options, terminal); };
    }
  });
}

}  // namespace limber::demos
