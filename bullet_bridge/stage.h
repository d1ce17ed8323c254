#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bullet_bridge/co_simulation.h"
#include "bullet_bridge/stage_body.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// How a rigid body is and moves.
struct StageMotion {
  Vec3 centre = Vec3::Zero();  // m
  Mat3 rotation = Mat3::Identity();
  Vec3 velocity = Vec3::Zero();  // m/s
  Vec3 spin = Vec3::Zero();      // rad/s
};

// What a ray or a contact met.
struct StageThing {
  enum class Kind { kFloor, kBody, kObject } kind = Kind::kFloor;
  std::size_t index = 0;  // of add_body(), or of the CoSimulation's objects

  auto operator<=>(const StageThing&) const = default;
};

struct StageHit {
  StageThing thing;
  Vec3 at;      // m
  Vec3 normal;  // unit, out of what was hit
};

// What two things did to one another in the last tick.
struct StageContact {
  StageThing first, second;
  Vec3 at;               // m, where they push hardest
  double impulse = 0.0;  // N s, of all their points, whatever the direction
};

// How two bodies, or a body and the world, are joined.
struct StageJoint {
  enum class Kind { kBall, kHinge, kFixed } kind = Kind::kBall;
  std::size_t body = 0;
  std::optional<std::size_t> other;  // none: the world
  Vec3 at = Vec3::Zero();            // m
  Vec3 axis = Vec3::UnitY();         // of a hinge, unit
};

// A small Bullet world of its own with Limber in it, for programs that have no world yet and do not
// want to include Bullet.
class Stage {
 public:
  Stage(const Vec3& gravity, const CoSimulationSettings& settings);
  ~Stage();
  Stage(Stage&&) noexcept;

  void add_floor(double friction);  // the plane y = 0

  // Bodies count up from 0; the number of one that was removed is not used again.
  std::size_t add_body(const StageBody& body);
  void remove_body(std::size_t body);  // with its joints; once
  bool has_body(std::size_t body) const;
  StageMotion motion(std::size_t body) const;
  Vec3 centre(std::size_t body) const;                                        // m, as in motion()
  void set_motion(std::size_t body, const StageMotion& motion);               // wakes it
  void apply_impulse(std::size_t body, const Vec3& impulse, const Vec3& at);  // N s, m; wakes it
  void add_joint(const StageJoint& joint);  // also while the world runs; wakes what it joins

  // All pieces of an object of the CoSimulation move like this from now on, m/s and rad/s.
  void throw_object(std::size_t object, const Vec3& velocity, const Vec3& spin);

  // The first thing on the way from one place to the other.
  std::optional<StageHit> ray(const Vec3& from, const Vec3& to) const;

  // What a shape would touch there, ascending: bodies and the floor with all of their inside,
  // objects by their surface.
  std::vector<StageThing> overlaps(const SolidShape& shape, const Vec3& centre,
                                   const Mat3& rotation) const;

  // Of the last tick: pairs that press on one another, and at least one moves; each pair once,
  // those of rigid bodies first, in Bullet's order, then those of lattices with bodies.
  std::vector<StageContact> contacts() const;

  CoSimulation& co_simulation();
  const CoSimulation& co_simulation() const;

  // One tick, s. Throws SimulationError when a lattice had to be stopped.
  void step(double tick);

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
