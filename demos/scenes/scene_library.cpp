#include <cmath>
#include <filesystem>

#include "core/model/nearest_name.h"
#include "core/model/validate.h"
#include "demos/scenes/scenes.h"

namespace limber::demos {
namespace {

// The name of a scene, or a model file.
SceneEntry find_scene(const std::string& name) {
  for (const SceneEntry& entry : scene_library()) {
    if (entry.name == name) return entry;
  }
  if (std::filesystem::is_regular_file(name)) return drop_of(name);
  throw InputError({"scene " + name, "there is no scene of that name, nor a model file",
                    "did you mean " + std::string(nearest_name(scene_library(), name)) +
                        "? 'limber run' lists them all"});
}

ParameterValues values_for(const SceneEntry& entry, const ParameterValues& changes) {
  ParameterValues values;
  for (const Parameter& p : entry.parameters) values[p.name] = p.value;
  for (const auto& [name, value] : changes) {
    if (!values.contains(name)) {
      throw InputError({"scene " + entry.name + ": parameter " + name, "there is none of that name",
                        "did you mean " + std::string(nearest_name(entry.parameters, name)) + "?"});
    }
    if (!std::isfinite(value)) {
      throw InputError({"scene " + entry.name + ": parameter " + name, "it is not a finite number",
                        "give a number"});
    }
    values[name] = value;
  }
  return values;
}

}  // namespace

const std::vector<SceneEntry>& scene_library() {
  static const std::vector<SceneEntry> scenes = {tipsy_teapot(), jelly_and_brick(), leaf_magic(),
                                                swing()};
  return scenes;
}

Scene build_scene(const std::string& name, const ParameterValues& changes) {
  const SceneEntry entry = find_scene(name);
  Scene scene = entry.build(values_for(entry, changes));
  for (const PhysicalModel& model : scene.objects) require_valid(model);
  return scene;
}

}  // namespace limber::demos
