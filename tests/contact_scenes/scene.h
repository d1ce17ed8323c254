#pragma once

#include <btBulletCollisionCommon.h>
#include <btBulletDynamicsCommon.h>

#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bullet_bridge/co_simulation.h"
#include "core/model/physical_model.h"

// Scenes of flexible bodies that touch rigid ones and each other, and what must hold in them. A
// scene knows no engine: it runs with Limber and with Bullet's own soft bodies alike.

namespace limber::bullet::test {

inline constexpr double kFrame = 1.0 / 60.0;  // s: measured this often, whatever the tick is
inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// With everything it refers to (meshes, parts of compounds).
using Shape = std::shared_ptr<btCollisionShape>;

struct RigidSpec {
  Shape shape;
  double mass = 0.0;             // kg; 0: static, or kinematic with a path
  Vec3 position = Vec3::Zero();  // m
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 velocity = Vec3::Zero();  // m/s
  double friction = 0.5;
  std::function<Vec3(double time)> path = nullptr;  // kinematic: position, m
};

// What is in the world at one time.
struct SceneState {
  double time = 0.0;                      // s
  std::vector<PhysicalModel> flexible;    // in the scene's order
  std::vector<const btRigidBody*> rigid;  // in the scene's order
};

// A number that must not be larger than `most`.
struct Demand {
  enum class When { kAlways, kAtEnd };
  std::string what;  // with its unit
  double most = 0.0;
  When when = When::kAlways;
  std::function<double(const SceneState&)> value;
};

// Those that every scene can be asked for; without a limit they are only reported.
struct Limits {
  double penetration = kNoLimit;  // m, deepest of any frame
  // Above the start, of any frame, as a share of the start's: kinetic, elastic and potential with
  // its zero at y = 0.
  double energy_rise = 0.01;
  double rest_speed = kNoLimit;  // m/s, of the fastest body at the end
  // |P - P(0)| of any frame as a share of the sum of all |p| at the start: for scenes without
  // anything immovable and without gravity. The same for L, about the origin.
  double momentum_error = kNoLimit;
};

struct Scene {
  std::string name;
  std::vector<RigidSpec> rigid = {};
  std::vector<PhysicalModel> flexible = {};
  double seconds = 3.0;
  int frames_between = 1;  // measured
  double gravity = 9.81;   // m/s^2, downwards
  Representation representation = Representation::kAlwaysFlexible;
  Limits limits = {};
  std::vector<Demand> demands = {};
  bool slow = false;  // minutes
};

}  // namespace limber::bullet::test
