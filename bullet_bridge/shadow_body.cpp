#include "bullet_bridge/shadow_body.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "bullet_bridge/conversions.h"
#include "core/dynamics/free_rotation.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

void refresh_rotation(ShadowBody& shadow) {
  shadow.rotation = shadow.orientation.toRotationMatrix();
  shadow.inverse_inertia =
      shadow.rotation * shadow.inverse_inertia_local * shadow.rotation.transpose();
}

}  // namespace

ShadowBody make_shadow(const btCollisionObject& object) {
  ShadowBody shadow;
  const btTransform& pose = object.getWorldTransform();
  shadow.position = shadow.start_position = from_bullet(pose.getOrigin());
  shadow.orientation = shadow.start_orientation = from_bullet(pose.getRotation());
  auto* body = const_cast<btRigidBody*>(btRigidBody::upcast(&object));
  if (body) {
    shadow.body = body;
    shadow.velocity = from_bullet(body->getLinearVelocity());
    shadow.angular_velocity = from_bullet(body->getAngularVelocity());
  }
  if (body && !body->isStaticOrKinematicObject()) {
    shadow.inverse_mass = body->getInvMass();
    shadow.inverse_inertia_local = from_bullet(body->getInvInertiaDiagLocal()).asDiagonal();
  }
  refresh_rotation(shadow);
  return shadow;
}

void apply_forces(ShadowBody& shadow, double dt) {
  shadow.velocity += shadow.force * (shadow.inverse_mass * dt);
  shadow.angular_velocity += shadow.inverse_inertia * shadow.torque * dt;
  shadow.force.setZero();
  shadow.torque.setZero();
}

void advance_pose(ShadowBody& shadow, double dt) {
  shadow.position += shadow.velocity * dt;
  shadow.orientation = turned(shadow.orientation, shadow.angular_velocity, dt);
  refresh_rotation(shadow);
}

void write_velocity(const ShadowBody& shadow, const Vec3& velocity) {
  shadow.body->setLinearVelocity(to_bullet(velocity));
  shadow.body->setAngularVelocity(to_bullet(shadow.angular_velocity));
}

void correct_pose(const ShadowBody& shadow, double tick) {
  btTransform pose = shadow.body->getWorldTransform();
  const Vec3 shift = shadow.position - shadow.start_position - shadow.velocity * tick;
  const Eigen::Quaterniond straight =
      turned(shadow.start_orientation, shadow.angular_velocity, tick);
  const Eigen::Quaterniond turn = shadow.orientation * straight.conjugate();
  pose.setOrigin(to_bullet(from_bullet(pose.getOrigin()) + shift));
  pose.setRotation(to_bullet((turn * from_bullet(pose.getRotation())).normalized()));
  shadow.body->setWorldTransform(pose);
  shadow.body->setInterpolationWorldTransform(pose);
  shadow.body->updateInertiaTensor();
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
