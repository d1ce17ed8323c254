#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "demos/scripting/script_scene.h"

namespace limber::demos::test {

inline ScriptSource script_of_text(const std::string& text) { return {"test.lua", text, {}}; }

// The scene of a script.
inline Scene scene_of_text(const std::string& text, const ScriptSettings& settings = {}) {
  const SceneEntry entry = script_entry(script_of_text(text), settings);
  ParameterValues values;
  for (const Parameter& p : entry.parameters) values[p.name] = p.value;
  return entry.build(values);
}

// What a script says that fails while it sets its scene up; a failure where it does not.
inline Diagnostic refusal_of_text(const std::string& text, const ScriptSettings& settings = {}) {
  try {
    scene_of_text(text, settings);
  } catch (const InputError& error) {
    return error.diagnostic;
  }
  ADD_FAILURE() << "was accepted:\n" << text;
  return {};
}

// What it printed on the way.
struct ScriptRun {
  RunResult result;
  std::string printed;
};

inline std::string failure_of(const ScriptRun& run) {
  return run.result.failure ? run.result.failure->text() : "";
}

inline ScriptRun run_of_text(const std::string& text, double seconds,
                             ScriptSettings settings = {}) {
  std::ostringstream printed;
  settings.printed = &printed;
  RunOptions options;
  options.seconds = seconds;
  RunResult result = run(scene_of_text(text, settings), options);
  return {std::move(result), printed.str()};
}

}  // namespace limber::demos::test
