#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bullet_bridge/stage.h"
#include "core/environment/environment.h"
#include "core/model/errors.h"
#include "core/model/physical_model.h"

namespace limber::demos {

// A body of the rigid world, in the state that it starts in.
struct RigidBody : bullet::StageBody {
  std::string name;
  Vec3 colour = {0.6, 0.5, 0.4};
};

// A box without a rotation, as most are.
RigidBody rigid_box(const std::string& name, const Vec3& half_extents_m, const Vec3& centre_m,
                    double mass_kg);

struct Camera {
  Vec3 position = {0.0, 1.0, 2.0};  // m
  Vec3 target = {0.0, 0.5, 0.0};    // m
  double field_of_view_deg = 30.0;  // vertical: any shape of picture shows the same height
  // Above 0 it goes, the way it looks, where the objects of the picture fill it (framing.h) at 1,
  // and that many times as near as that.
  double zoom = 0.0;
};

// A point that shines in all directions.
struct Light {
  Vec3 position = Vec3::Zero();   // m
  Vec3 colour = {1.0, 1.0, 1.0};  // linear RGB; 1 shows colours as they are where it meets them
  bool shadows = true;
};

class Simulation;

// What happens in a scene beside physics. One run has one; the simulation calls it between ticks.
// It may do anything that a Simulation lets one do, and end the run by a SimulationError.
class Behaviour {
 public:
  virtual ~Behaviour() = default;
  virtual void start(Simulation& simulation) = 0;
  virtual void before_tick(Simulation& simulation, double dt) = 0;  // s, of the coming tick
  virtual void after_tick(Simulation& simulation) = 0;
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
  std::vector<RigidBody> bodies;
  std::vector<bullet::StageJoint> joints;
  std::vector<PhysicalModel> objects;
  std::optional<bullet::SwitchSettings> switching = {};  // none: the usual ones
  // How objects are integrated, by their index; the others as the run has it.
  std::map<std::size_t, bullet::Integration> integration;
  Camera camera;
  std::vector<Light> lights;           // none: a photographer's, that go with the camera
  std::vector<Diagnostic> notes = {};  // what a user should know before it runs
  std::function<std::unique_ptr<Behaviour>()> behaviour = {};  // a new one for every run
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

// The scenes that ship with Limber: the scripts in assets/scenes, by name.
const std::vector<SceneEntry>& scene_library();

// Builds a scene by name, of the script in the file of that name (.lua), or one that drops the
// model in it; `changes` replace defaults. Throws InputError for an unknown scene or parameter
// (naming the nearest one), for a value out of range, for a model that validate() refuses, for what
// is wrong in a script, and as read_model(). Notes what is too soft to land on the floor.
Scene build_scene(const std::string& name, const ParameterValues& changes = {});

}  // namespace limber::demos
