#pragma once

#include <Eigen/Geometry>

#include "core/model/vec3.h"

namespace limber {

// A rigid body that is pushed at points and flies freely in between. World frame; its own axes are
// its principal axes.
//
// Symplectic Euler: apply_forces() with the pose as it is, then advance_pose(). Forces that are
// equal and opposite to those on a lattice, at the same points, keep the momentum and the angular
// momentum of both to rounding.
struct RigidBody {
  double inverse_mass = 0.0;                  // 1/kg, 0: immovable, keeps its velocities
  Mat3 inverse_inertia_local = Mat3::Zero();  // 1/(kg m^2), own axes: diagonal; 0: does not turn

  // Of what an impulse moves, along and about the world's axes: 0 for an axis that is locked. As in
  // Bullet, they multiply the inverse inertia; momentum and energy are those of a free body.
  Vec3 linear_factor = Vec3::Ones(), angular_factor = Vec3::Ones();

  Vec3 position = Vec3::Zero();                                     // of the centre of mass, m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // own axes to world
  Mat3 rotation = Mat3::Identity();                                 // the same as a matrix
  Mat3 inverse_inertia = Mat3::Zero();   // world axes, without those that are locked
  Vec3 velocity = Vec3::Zero();          // m/s
  Vec3 angular_velocity = Vec3::Zero();  // rad/s

  Vec3 force = Vec3::Zero();   // of this step, N
  Vec3 torque = Vec3::Zero();  // of this step about the centre of mass, N m

  bool movable() const { return inverse_mass > 0.0; }
  bool turns_freely() const { return angular_factor == Vec3::Ones(); }
  bool moves() const { return !velocity.isZero(0.0) || !angular_velocity.isZero(0.0); }
  Vec3 velocity_at(const Vec3& point) const {
    return velocity + angular_velocity.cross(point - position);
  }
  void add_force(const Vec3& f, const Vec3& at) {
    force += f;
    torque += (at - position).cross(f);
  }
  void apply_impulse(const Vec3& impulse, const Vec3& at) {
    velocity += inverse_mass * linear_factor.cwiseProduct(impulse);
    angular_velocity += inverse_inertia * (at - position).cross(impulse);
  }
  // 1 / effective mass for an impulse along n at a point.
  double inverse_effective_mass(const Vec3& at, const Vec3& n) const {
    const Vec3 arm = (at - position).cross(n);
    return inverse_mass * n.dot(linear_factor.cwiseProduct(n)) + arm.dot(inverse_inertia * arm);
  }
};

// What follows from the orientation: call it after setting that, the inertia or the factors.
void refresh_rotation(RigidBody& body);

// The force and torque of this step become velocity, and are cleared.
void apply_forces(RigidBody& body, double dt);

// Moves the pose by the present velocity. A body that may turn about every axis turns as a free one
// does, its angular momentum kept to rounding (rotate_freely()); any other keeps its angular
// velocity.
void advance_pose(RigidBody& body, double dt);

// Of a body that has a mass and all three moments.
Vec3 angular_momentum(const RigidBody& body);  // about its centre of mass, kg m^2/s
double kinetic_energy(const RigidBody& body);  // J

}  // namespace limber
