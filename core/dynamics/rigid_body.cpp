#include "core/dynamics/rigid_body.h"

#include "core/dynamics/free_rotation.h"

namespace limber {
namespace {

bool turns_about_all_axes(const RigidBody& body) {
  return body.inverse_inertia_local.diagonal().minCoeff() > 0.0 && body.turns_freely();
}

bool is_symmetric(const RigidBody& body) {
  const Vec3 inverse = body.inverse_inertia_local.diagonal();
  return inverse.minCoeff() == inverse.maxCoeff();
}

}  // namespace

void refresh_rotation(RigidBody& body) {
  body.rotation = body.orientation.toRotationMatrix();
  body.inverse_inertia = body.angular_factor.asDiagonal() * body.rotation *
                         body.inverse_inertia_local * body.rotation.transpose() *
                         body.angular_factor.asDiagonal();
}

void apply_forces(RigidBody& body, double dt) {
  body.velocity += body.linear_factor.cwiseProduct(body.force) * (body.inverse_mass * dt);
  body.angular_velocity += body.inverse_inertia * body.torque * dt;
  body.force.setZero();
  body.torque.setZero();
}

// Where all moments are equal, the angular velocity of a free body stays as it is.
void advance_pose(RigidBody& body, double dt) {
  body.position += body.velocity * dt;
  if (turns_about_all_axes(body) && !is_symmetric(body)) {
    const Vec3 moments = body.inverse_inertia_local.diagonal().cwiseInverse();
    rotate_freely(body.orientation, body.angular_velocity, moments, dt);
  } else {
    body.orientation = turned(body.orientation, body.angular_velocity, dt);
  }
  refresh_rotation(body);
}

Vec3 angular_momentum(const RigidBody& body) {
  const Vec3 local = body.rotation.transpose() * body.angular_velocity;
  return body.rotation * local.cwiseQuotient(body.inverse_inertia_local.diagonal());
}

double kinetic_energy(const RigidBody& body) {
  return 0.5 * (body.velocity.squaredNorm() / body.inverse_mass +
                body.angular_velocity.dot(angular_momentum(body)));
}

}  // namespace limber
