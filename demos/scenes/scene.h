#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/environment/environment.h"
#include "core/model/errors.h"
#include "core/model/physical_model.h"

namespace limber::demos {

// A box of the rigid world; mass 0 makes it static.
struct RigidBox {
  std::string name;
  Vec3 half_extents;  // m
  Vec3 centre;        // m
  double mass = 0.0;  // kg
  double friction = 0.5;
  double restitution = 0.0;
  Vec3 colour = {0.6, 0.5, 0.4};
};

struct Camera {
  Vec3 position = {0.0, 1.0, 2.0};  // m
  Vec3 target = {0.0, 0.5, 0.0};    // m
  double field_of_view_deg = 30.0;  // vertical: any shape of picture shows the same height
  // Above 0 it goes, the way it looks, where the objects of the picture fill it (framing.h) at 1,
  // and that many times as near as that.
  double zoom = 0.0;
};

// Everything that one run needs: demo, test, benchmark and bug report share it. Static floor at
// y = 0 where `floor` says so. Objects are placed and in motion already.
struct Scene {
  std::string name;
  double seconds = 4.0;      // default length, s
  double tick = 1.0 / 60.0;  // default step of the rigid world, s
  Vec3 gravity = {0.0, -9.81, 0.0};
  std::optional<Air> air;  // none: vacuum
  bool floor = true;
  double floor_friction = 0.5;
  std::vector<RigidBox> boxes;
  std::vector<PhysicalModel> objects;
  Camera camera;
  std::vector<Diagnostic> notes = {};  // what a user should know before it runs
};

// A number of the scene that `--set NAME=VALUE` changes.
struct Parameter {
  std::string name;
  double value = 0.0;
  std::string unit;
  std::string meaning;
  double least = 0.0, most = 0.0;  // both allowed
};

using ParameterValues = std::map<std::string, double>;

struct SceneEntry {
  std::string name;
  std::string summary;
  std::vector<Parameter> parameters;
  std::function<Scene(const ParameterValues&)> build;  // gets a value for every parameter
};

// The scenes that ship with Limber.
const std::vector<SceneEntry>& scene_library();

// Builds a scene by name, or one that drops the model in the file of that name; `changes` replace
// defaults. Throws InputError for an unknown scene or parameter (naming the nearest one), for a
// value out of range, for a model that validate() refuses, and as read_model(). Notes what is too
// soft to land on the floor.
Scene build_scene(const std::string& name, const ParameterValues& changes = {});

}  // namespace limber::demos
