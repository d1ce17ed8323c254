#include "demos/scripting/script_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>

namespace limber::demos {
namespace {

Scene build(const ScriptSource& source, const ParameterValues& values,
            const ScriptSettings& settings) {
  Script script(source, values, settings);
  Scene scene = script.scene();
  if (script.has_callbacks()) {
    ScriptSettings again = settings;
    again.silent_set_up = true;
    scene.behaviour = [source, values, again] {
      return std::make_unique<Script>(source, values, again);
    };
  }
  return scene;
}

}  // namespace

SceneEntry script_entry(const ScriptSource& source, const ScriptSettings& settings) {
  const ScriptHeader header = read_header(source, settings);
  return {source.name, header.summary, header.parameters,
          [source, settings](const ParameterValues& values) {
            return build(source, values, settings);
          }};
}

std::vector<InputEvent> read_inputs(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError({file.string(), "it cannot be read", "check the name and rights"});
  std::vector<InputEvent> inputs;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    InputEvent input;
    const bool good = static_cast<bool>(words >> input.time_s >> input.name >> input.value);
    if (!good || !std::isfinite(input.time_s) || input.time_s < 0.0 || !(words >> std::ws).eof()) {
      throw InputError({fmt::format("{}:{}", file.string(), number), "it is no input",
                        "write the time in s, a name and a number: 0.5 throw 1"});
    }
    inputs.push_back(input);
  }
  return inputs;
}

}  // namespace limber::demos
