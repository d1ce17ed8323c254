#include "bullet_bridge/shadow_body.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <LinearMath/btTransformUtil.h>

#include "bullet_bridge/body_motion.h"
#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

constexpr int kGyroscopicFlags = BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT |
                                 BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD |
                                 BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;

// Where Bullet moves the body by the shadow's velocities alone: its own exponential map, which cuts
// turns of more than an eighth.
btTransform moved_by_bullet(const ShadowBody& shadow, double tick) {
  const btTransform start(to_bullet(shadow.start_orientation), to_bullet(shadow.start_position));
  btTransform end;
  btTransformUtil::integrateTransform(start, to_bullet(shadow.velocity),
                                      to_bullet(shadow.angular_velocity),
                                      static_cast<btScalar>(tick), end);
  return end;
}

Mat3 inertia_at(const Vec3& moments, const Eigen::Quaterniond& orientation) {
  const Mat3 axes = orientation.toRotationMatrix();
  return axes * moments.asDiagonal() * axes.transpose();
}

// The impulses that Bullet gave besides are meant for the pose at the tick's start: J there is
// J x shift too much about the centre where the body is, and a spin was given to another inertia.
void keep_angular_momentum(const ShadowBody& shadow, const Vec3& shift) {
  btRigidBody& body = *shadow.body;
  const btVector3 dv = body.getLinearVelocity() - to_bullet(shadow.velocity);
  const btVector3 spun = body.getAngularVelocity() - to_bullet(shadow.angular_velocity);
  const Vec3 inverse = shadow.inverse_inertia_local.diagonal();
  if ((dv.isZero() && spun.isZero()) || inverse.minCoeff() <= 0.0 || !shadow.turns_freely()) return;
  const Vec3 moments = inverse.cwiseInverse();
  const Vec3 L = angular_momentum(shadow) +
                 inertia_at(moments, shadow.start_orientation) * from_bullet(spun) -
                 shift.cross(from_bullet(dv)) / shadow.inverse_mass;
  const Eigen::Quaterniond now = from_bullet(body.getWorldTransform().getRotation());
  body.setAngularVelocity(to_bullet(now * (now.conjugate() * L).cwiseProduct(inverse)));
}

bool has_velocity_of(const btRigidBody& body, const ShadowBody& shadow) {
  return body.getLinearVelocity() == to_bullet(shadow.velocity) &&
         body.getAngularVelocity() == to_bullet(shadow.angular_velocity);
}

// Bullet starts from a matrix, moved_by_bullet() from a quaternion.
bool is_same_but_rounding(const btTransform& a, const btTransform& b) {
  constexpr btScalar kSame = 16 * SIMD_EPSILON;
  const btScalar size = btMax(b.getOrigin().length(), btScalar(1));
  return (a.getOrigin() - b.getOrigin()).length() < kSame * size &&
         (a.getBasis() - b.getBasis()).getColumn(0).length() < kSame &&
         (a.getBasis() - b.getBasis()).getColumn(1).length() < kSame;
}

void place(btRigidBody& body, const btTransform& pose) {
  body.setWorldTransform(pose);
  body.setInterpolationWorldTransform(pose);
  body.updateInertiaTensor();
}

}  // namespace

ShadowBody make_shadow(const btCollisionObject& object) {
  ShadowBody shadow;
  const btTransform& pose = object.getWorldTransform();
  shadow.position = shadow.start_position = from_bullet(pose.getOrigin());
  shadow.orientation = shadow.start_orientation = from_bullet(pose.getRotation());
  const BodySpeeds motion = motion_of(object);
  shadow.velocity = motion.velocity;
  shadow.angular_velocity = motion.angular_velocity;
  auto* body = const_cast<btRigidBody*>(btRigidBody::upcast(&object));
  if (body) {
    shadow.body = body;
    shadow.flags = body->getFlags();
  }
  if (is_movable(object)) {
    shadow.inverse_mass = body->getInvMass();
    shadow.inverse_inertia_local = from_bullet(body->getInvInertiaDiagLocal()).asDiagonal();
    shadow.linear_factor = from_bullet(body->getLinearFactor());
    shadow.angular_factor = from_bullet(body->getAngularFactor());
  }
  refresh_rotation(shadow);
  return shadow;
}

void write_velocity(const ShadowBody& shadow, const Vec3& velocity) {
  shadow.body->setLinearVelocity(to_bullet(velocity));
  shadow.body->setAngularVelocity(to_bullet(shadow.angular_velocity));
  shadow.body->setFlags(shadow.flags & ~kGyroscopicFlags);
}

void correct_pose(ShadowBody& shadow, double tick) {
  btRigidBody& body = *shadow.body;
  const btTransform straight = moved_by_bullet(shadow, tick);
  body.setFlags(shadow.flags);
  if (has_velocity_of(body, shadow) && is_same_but_rounding(body.getWorldTransform(), straight)) {
    shadow.left_at.emplace(to_bullet(shadow.orientation), to_bullet(shadow.position));
    place(body, *shadow.left_at);
    return;
  }
  const Vec3 shift = shadow.position - from_bullet(straight.getOrigin());
  const Eigen::Quaterniond turn =
      shadow.orientation * from_bullet(straight.getRotation()).conjugate();
  btTransform pose = body.getWorldTransform();
  pose.setOrigin(to_bullet(from_bullet(pose.getOrigin()) + shift));
  pose.setRotation(to_bullet((turn * from_bullet(pose.getRotation())).normalized()));
  place(body, pose);
  keep_angular_momentum(shadow, shift);
}

void go_on_from(ShadowBody& shadow, const ShadowBody& last_tick) {
  if (!last_tick.left_at || !shadow.movable()) return;
  const btRigidBody& body = *shadow.body;
  if (!(body.getWorldTransform() == *last_tick.left_at)) return;
  if (!has_velocity_of(body, last_tick)) return;
  shadow.position = shadow.start_position = last_tick.position;
  shadow.orientation = shadow.start_orientation = last_tick.orientation;
  shadow.velocity = last_tick.velocity;
  shadow.angular_velocity = last_tick.angular_velocity;
  refresh_rotation(shadow);
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
