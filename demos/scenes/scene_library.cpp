#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/model/bounds.h"
#include "core/model/nearest_name.h"
#include "core/model/validate.h"
#include "core/modeller/softness.h"
#include "demos/scripting/script_scene.h"

namespace limber::demos {
namespace {

// The name of a scene that ships, a script or a model file.
SceneEntry find_scene(const std::string& name, const ScriptSettings& settings) {
  if (const auto shipped = shipped_script(name)) return script_entry(*shipped, settings);
  const std::filesystem::path file(name);
  if (std::filesystem::is_regular_file(file)) {
    if (file.extension() != ".lua") return drop_entry(name, settings);
    return script_entry(script_in_file(file, settings.limits.file_bytes), settings);
  }
  throw InputError({"scene " + name, "there is no scene of that name, nor a script or model file",
                    "did you mean " + std::string(nearest_name(scene_library(), name)) +
                        "? 'limber run' lists them all"});
}

// "-20 m/s": as it was typed, or nearly.
std::string with_unit(double value, const std::string& unit) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  return text.str() + (unit.empty() ? "" : " " + unit);
}

void require_in_range(const std::string& where, const Parameter& p, double value) {
  if (!std::isfinite(value))
    throw InputError({where, "it is not a finite number", "give a number"});
  if (value >= p.least && value <= p.most) return;
  throw InputError({where, with_unit(value, p.unit) + " is out of range",
                    "give " + with_unit(p.least, "") + " to " + with_unit(p.most, p.unit)});
}

ParameterValues values_for(const SceneEntry& entry, const ParameterValues& changes) {
  ParameterValues values;
  for (const Parameter& p : entry.parameters) values[p.name] = p.value;
  for (const auto& [name, value] : changes) {
    const std::string where = "scene " + entry.name + ": parameter " + name;
    const auto found = std::ranges::find(entry.parameters, name, &Parameter::name);
    if (entry.parameters.empty()) {
      throw InputError({where, "the scene has no parameters", "leave --set out"});
    }
    if (found == entry.parameters.end()) {
      throw InputError({where, "there is none of that name",
                        "did you mean " + std::string(nearest_name(entry.parameters, name)) + "?"});
    }
    require_in_range(where, *found, value);
    values[name] = value;
  }
  return values;
}

// m/s at the floor, of free fall from where and as the model starts; 0 where it does not come down.
double landing_speed(const PhysicalModel& model, double gravity) {
  const double height = std::max(0.0, bounds_of(model.geometry.points).min().y());
  double momentum = 0.0;
  for (const PointAttributes& point : model.points) momentum += point.mass * point.velocity.y();
  const double upwards = momentum / total_mass(model);
  return std::sqrt(upwards * upwards + 2.0 * gravity * height);
}

void note_softness(Scene& scene, const std::string& name) {
  if (!scene.floor || scene.gravity.y() >= 0.0) return;
  const double gravity = -scene.gravity.y();
  for (const PhysicalModel& model : scene.objects) {
    const auto note =
        softness_note(name + ": " + model.name, model, landing_speed(model, gravity), gravity);
    if (note) scene.notes.push_back(*note);
  }
}

}  // namespace

RigidBody rigid_box(const std::string& name, const Vec3& half_extents_m, const Vec3& centre_m,
                    double mass_kg) {
  RigidBody body;
  body.shape = bullet::BoxShape{half_extents_m};
  body.name = name;
  body.centre = centre_m;
  body.mass = mass_kg;
  return body;
}

const std::vector<SceneEntry>& scene_library() {
  static const std::vector<SceneEntry> scenes = [] {
    std::vector<SceneEntry> all;
    for (const std::string& name : shipped_scripts()) {
      all.push_back(script_entry(*shipped_script(name), {}));
    }
    return all;
  }();
  return scenes;
}

Scene build_scene(const std::string& name, const ParameterValues& changes) {
  return build_scene(name, changes, {});
}

Scene build_scene(const std::string& name, const ParameterValues& changes,
                  const ScriptSettings& settings) {
  const SceneEntry entry = find_scene(name, settings);
  Scene scene = entry.build(values_for(entry, changes));
  for (const PhysicalModel& model : scene.objects) require_valid(model);
  note_softness(scene, name);
  return scene;
}

}  // namespace limber::demos
