#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/model/validate.h"
#include "demos/scenes/scenes.h"

namespace limber::demos {
namespace {

// Levenshtein's edit distance.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, change}));
    }
  }
  return row.back();
}

template <class Named>
std::string nearest_name(const std::vector<Named>& items, const std::string& name) {
  const auto nearest = std::min_element(items.begin(), items.end(), [&](auto& a, auto& b) {
    return distance(a.name, name) < distance(b.name, name);
  });
  return nearest->name;
}

const SceneEntry& find_scene(const std::string& name) {
  for (const SceneEntry& entry : scene_library()) {
    if (entry.name == name) return entry;
  }
  throw InputError(
      {"scene " + name, "there is no scene of that name",
       "did you mean " + nearest_name(scene_library(), name) + "? 'limber run' lists them all"});
}

ParameterValues values_for(const SceneEntry& entry, const ParameterValues& changes) {
  ParameterValues values;
  for (const Parameter& p : entry.parameters) values[p.name] = p.value;
  for (const auto& [name, value] : changes) {
    if (!values.contains(name)) {
      throw InputError({"scene " + entry.name + ": parameter " + name, "there is none of that name",
                        "did you mean " + nearest_name(entry.parameters, name) + "?"});
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
  static const std::vector<SceneEntry> scenes = {tipsy_teapot(), jelly_and_brick()};
  return scenes;
}

Scene build_scene(const std::string& name, const ParameterValues& changes) {
  const SceneEntry& entry = find_scene(name);
  Scene scene = entry.build(values_for(entry, changes));
  for (const PhysicalModel& model : scene.objects) require_valid(model);
  return scene;
}

}  // namespace limber::demos
