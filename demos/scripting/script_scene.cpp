#include "demos/scripting/script_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>

#include "core/model/validate.h"
#include "core/storage/model_file.h"

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

// With the model that the script gets.
Scene build_drop(const std::string& model_file, const ParameterValues& values,
                 ScriptSettings settings) {
  const auto model = std::make_shared<const PhysicalModel>(read_model(model_file));
  if (model->points.empty()) {
    throw InputError({"scene " + model->name, "the model has no points", "give one that has"});
  }
  require_valid(*model);
  settings.limits.points += model->points.size();  // they are the user's, not the script's
  ScriptSource source = drop_script();
  source.model = model;
  Scene scene = build(source, values, settings);
  scene.name = model->name;
  return scene;
}

}  // namespace

SceneEntry drop_entry(const std::string& model_file, const ScriptSettings& settings) {
  const ScriptHeader header = read_header(drop_script(), settings);
  return {model_file, header.summary, header.parameters,
          [model_file, settings](const ParameterValues& values) {
            return build_drop(model_file, values, settings);
          }};
}

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
