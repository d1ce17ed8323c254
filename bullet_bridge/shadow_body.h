#pragma once

#include <LinearMath/btTransform.h>

#include <optional>

#include "bullet_bridge/precision.h"
#include "core/dynamics/rigid_body.h"

class btRigidBody;
class btCollisionObject;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A rigid body of Bullet's world for the length of one tick, in double and at the substep rate. A
// body held still while a lattice hits it gains energy out of nothing (up to twentyfold, measured),
// although momentum stays exact; its shadow moves with every substep.
//
// Bullet adds gravity when it solves, so that the shadow of a body that stands on something goes
// without; that of an airborne one, or of one that lattices alone bear, falls with the lattice and
// is written back without the tick's gravity. A shadow turns as a free body does, whatever Bullet's
// flags for gyroscopic torque are, which Bullet would add once more: they are off from
// write_velocity() to correct_pose().
struct ShadowBody : RigidBody {
  btRigidBody* body = nullptr;  // null for things that no impulse moves: links, bare objects
  int flags = 0;                // the body's own

  Vec3 start_position;  // at the tick's start
  Eigen::Quaterniond start_orientation;
  bool touched = false;  // did anything push it in this tick
  // Where the body was left when the lattice alone had moved it; Bullet's scalars are rounded.
  std::optional<btTransform> left_at;

  void add_force(const Vec3& f, const Vec3& at) {
    RigidBody::add_force(f, at);
    touched = true;
  }
};

ShadowBody make_shadow(const btCollisionObject& object);

// Gives the shadow's body a velocity (the shadow's, less what Bullet is about to add) and its own
// angular velocity. The pose is corrected after Bullet moved it.
void write_velocity(const ShadowBody& shadow, const Vec3& velocity);

// Adds to the body's pose what the shadow's path in this tick differs from the one at the final
// velocities, which Bullet has integrated. A body that nothing else pushed is where the shadow is.
void correct_pose(ShadowBody& shadow, double tick);

// Where the body still is as it was left in the last tick, its shadow goes on from the unrounded
// state: in single precision a spin would lose a share of 1e-8 in every tick otherwise.
void go_on_from(ShadowBody& shadow, const ShadowBody& last_tick);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
