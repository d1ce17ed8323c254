#pragma once

#include <Eigen/Geometry>

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

class btRigidBody;
class btCollisionObject;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A rigid body of Bullet's world for the length of one tick, in double and at the substep rate. A
// body held still while a lattice hits it gains energy out of nothing (up to twentyfold, measured),
// although momentum stays exact; its shadow moves with every substep.
//
// Bullet adds gravity when it solves, so that the shadow of a supported body goes without; that of
// an airborne one falls with the lattice and is written back without the tick's gravity.
struct ShadowBody {
  btRigidBody* body = nullptr;                // null for immovable things without a velocity
  double inverse_mass = 0.0;                  // 1/kg, 0 for static and kinematic bodies
  Mat3 inverse_inertia_local = Mat3::Zero();  // 1/(kg m^2), body frame

  Vec3 position;                         // of the centre of mass, m
  Eigen::Quaterniond orientation;        // body to world
  Mat3 rotation;                         // the same as a matrix
  Mat3 inverse_inertia;                  // world frame
  Vec3 velocity = Vec3::Zero();          // m/s
  Vec3 angular_velocity = Vec3::Zero();  // rad/s

  Vec3 start_position;  // at the tick's start
  Eigen::Quaterniond start_orientation;
  Vec3 force = Vec3::Zero();   // of this substep, N
  Vec3 torque = Vec3::Zero();  // of this substep about the centre of mass, N m
  bool touched = false;        // did anything push it in this tick

  bool movable() const { return inverse_mass > 0.0; }
  bool moves() const { return !velocity.isZero(0.0) || !angular_velocity.isZero(0.0); }
  Vec3 velocity_at(const Vec3& point) const {
    return velocity + angular_velocity.cross(point - position);
  }
  void add_force(const Vec3& f, const Vec3& at) {
    force += f;
    torque += (at - position).cross(f);
    touched = true;
  }
  void apply_impulse(const Vec3& impulse, const Vec3& at) {
    velocity += inverse_mass * impulse;
    angular_velocity += inverse_inertia * (at - position).cross(impulse);
  }
  // 1 / effective mass for an impulse along n at a point.
  double inverse_effective_mass(const Vec3& at, const Vec3& n) const {
    const Vec3 arm = (at - position).cross(n);
    return inverse_mass + arm.dot(inverse_inertia * arm);
  }
};

ShadowBody make_shadow(const btCollisionObject& object);

// The force and torque of this substep become velocity, and are cleared.
void apply_forces(ShadowBody& shadow, double dt);

// Moves the pose by the present velocity.
void advance_pose(ShadowBody& shadow, double dt);

// Gives the shadow's body a velocity (the shadow's, less what Bullet is about to add) and its own
// angular velocity. The pose is corrected after Bullet moved it.
void write_velocity(const ShadowBody& shadow, const Vec3& velocity);

// Adds to the body's pose what the shadow's path in this tick differs from the straight one at the
// final velocity, which Bullet has integrated.
void correct_pose(const ShadowBody& shadow, double tick);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
