#pragma once

#include "demos/scripting/script.h"

namespace limber::demos {

// A script as a scene: its summary and parameters, and how it is built. A script with callbacks or
// timers is the scene's behaviour; every run has it anew, from its first line on. Throws InputError
// with file, line and traceback.
SceneEntry script_entry(const ScriptSource& source, const ScriptSettings& settings);

// A model file as a scene: the model falls on the floor. It is read, and has to be valid, when the
// scene is built: throws InputError then.
SceneEntry drop_entry(const std::string& model_file, const ScriptSettings& settings);

// build_scene() of scene.h, with what scripts get.
Scene build_scene(const std::string& name, const ParameterValues& changes,
                  const ScriptSettings& settings);

// Inputs from a file: a line for each, "time name value", the time in s; lines that begin with #
// and empty ones say nothing. Throws InputError with the line.
std::vector<InputEvent> read_inputs(const std::filesystem::path& file);

}  // namespace limber::demos
