#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/model/errors.h"
#include "demos/cli/command.h"
#include "demos/scenes/scene.h"
#include "demos/scenes/simulation.h"
#include "demos/scripting/script.h"

namespace limber::demos {

// Where the facts go beside the tables.
struct OutputOptions {
  std::string json;  // file, "-" for standard output, empty for none
};

// What several commands ask for in the same words.
struct SceneOptions : OutputOptions {
  std::string scene;
  ParameterValues changes;  // of --set
  std::vector<InputEvent> inputs;
  RunOptions run;
  int threads = 1;
};

// Each adds one option (or the argument SCENE) to a command. The values are checked while the line
// is parsed and refused with an InputError.
void add_scene(CLI::App& command, SceneOptions& options, bool required);
void add_set(CLI::App& command, SceneOptions& options);
void add_inputs(CLI::App& command, SceneOptions& options);
void add_seconds(CLI::App& command, SceneOptions& options);
void add_tick(CLI::App& command, SceneOptions& options);
void add_policy(CLI::App& command, SceneOptions& options);
void add_integrator(CLI::App& command, SceneOptions& options);
void add_springs(CLI::App& command, SceneOptions& options);
void add_threads(CLI::App& command, SceneOptions& options);
void add_json(CLI::App& command, OutputOptions& options);

// The scene; what its script prints goes to standard error. `on_file`, where given, is called
// before a file is read that the scene's script names.
Scene scene_of(const SceneOptions& options, Terminal& terminal,
               const std::function<void(const std::filesystem::path&)>& on_file = {});

// Refuses an output that is the input: it would be gone.
void require_other_file(const std::string& input, const std::string& output);

// Checks before any work that the result can be delivered.
void require_json_target(const OutputOptions& options);

// Delivers `text` to where --json says; does nothing without --json.
void write_json(const OutputOptions& options, const std::string& text, Terminal& terminal);

// Says what a user should know, one line a note, on standard error: before long work begins.
void say_notes(const std::vector<Diagnostic>& notes, Terminal& terminal);

// Standard output belongs to the JSON alone once `--json -` asked for it.
bool tables_wanted(const OutputOptions& options);

}  // namespace limber::demos
