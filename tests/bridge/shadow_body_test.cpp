#include "bullet_bridge/shadow_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/bridge/measure.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

ShadowBody moving_shadow(World& world) {
  btRigidBody& body = world.add_box({0.1, 0.2, 0.3}, 3.0, {1.0, 2.0, 3.0});
  body.getWorldTransform().setRotation(
      btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.7)));
  body.setLinearVelocity(btVector3(1, -2, 3));
  body.setAngularVelocity(btVector3(btScalar(0.5), 2, -1));
  return make_shadow(body);
}

// A solid box: m / 3 of the squares of the other two half extents.
TEST(Shadow, HasTheMassOfItsBody) {
  World world;
  const ShadowBody shadow = moving_shadow(world);
  const double tolerance = by_precision(1e-5, 1e-12);
  EXPECT_NEAR(shadow.inverse_mass, 1.0 / 3.0, tolerance);
  const Vec3 moments(0.04 + 0.09, 0.01 + 0.09, 0.01 + 0.04);
  const Vec3 inverse = moments.cwiseInverse();
  EXPECT_LT((shadow.inverse_inertia_local.diagonal() - inverse).norm(), tolerance * inverse.norm());
  EXPECT_TRUE(shadow.movable());
}

TEST(Shadow, OfStaticAndKinematicBodiesDoesNotGiveWay) {
  World world;
  ShadowBody ground = make_shadow(world.add_ground());
  EXPECT_FALSE(ground.movable());
  ground.apply_impulse({1.0, 2.0, 3.0}, {0.3, 0.0, 0.0});
  EXPECT_FALSE(ground.moves());
  btRigidBody& lift = world.add_box({0.1, 0.1, 0.1}, 1.0, Vec3::Zero());
  lift.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  lift.setLinearVelocity(btVector3(0, 1, 0));
  const ShadowBody shadow = make_shadow(lift);
  EXPECT_FALSE(shadow.movable());
  EXPECT_TRUE(shadow.moves());
}

// Against the motion of a point that is fixed in the body, by central differences.
TEST(Shadow, VelocityAtAPointIsTheDerivativeOfItsPosition) {
  World world;
  const ShadowBody shadow = moving_shadow(world);
  const Vec3 local(0.05, -0.1, 0.2);
  constexpr double kStep = 1e-5;
  const auto position_after = [&](double dt) -> Vec3 {
    ShadowBody moved = shadow;
    advance_pose(moved, dt);
    return moved.position + moved.rotation * local;
  };
  const Vec3 numeric = (position_after(kStep) - position_after(-kStep)) / (2.0 * kStep);
  EXPECT_LT((shadow.velocity_at(position_after(0.0)) - numeric).norm(), 1e-8);
}

// dE = J . v at the point for a small impulse, and 1 / m_eff = n . dv.
TEST(Shadow, EffectiveMassIsTheAnswerToAnImpulse) {
  World world;
  ShadowBody shadow = moving_shadow(world);
  const Vec3 at = shadow.position + Vec3(0.1, -0.2, 0.05);
  const Vec3 normal = Vec3(1.0, 2.0, -2.0) / 3.0;
  const double before = normal.dot(shadow.velocity_at(at));
  shadow.apply_impulse(0.7 * normal, at);
  const double change = normal.dot(shadow.velocity_at(at)) - before;
  EXPECT_NEAR(change, 0.7 * shadow.inverse_effective_mass(at, normal), 1e-12);
}

TEST(Shadow, ForceOverTimeIsAnImpulse) {
  World world;
  ShadowBody pushed = moving_shadow(world), kicked = pushed;
  const Vec3 force(30.0, -20.0, 10.0), at = pushed.position + Vec3(0.0, 0.1, 0.2);
  pushed.add_force(force, at);
  EXPECT_TRUE(pushed.touched);
  apply_forces(pushed, 0.002);
  kicked.apply_impulse(0.002 * force, at);
  EXPECT_LT((pushed.velocity - kicked.velocity).norm(), 1e-14);
  EXPECT_LT((pushed.angular_velocity - kicked.angular_velocity).norm(), 1e-13);
  EXPECT_TRUE(pushed.force.isZero(0.0) && pushed.torque.isZero(0.0));
}

// Bullet moves the body straight at its final velocity; the correction puts it where the shadow is.
TEST(Shadow, CorrectedPoseIsTheShadowsOwn) {
  World world(0.0);
  ShadowBody shadow = moving_shadow(world);
  for (int n = 0; n < 64; ++n) {
    shadow.apply_impulse({0.01 * n, -0.02, 0.03}, shadow.position + Vec3(0.1, 0.0, 0.1));
    advance_pose(shadow, kTick / 64);
  }
  shadow.body->setFlags(0);
  write_velocity(shadow, shadow.velocity);
  world.step(kTick);
  correct_pose(shadow, kTick);
  const btTransform& pose = shadow.body->getWorldTransform();
  // Bullet's own exponential map and quaternion are good to 1e-6 or so at 3 rad/s.
  EXPECT_LT((from_bullet(pose.getOrigin()) - shadow.position).norm(), by_precision(2e-6, 1e-12));
  EXPECT_LT(from_bullet(pose.getRotation()).angularDistance(shadow.orientation),
            by_precision(1e-5, 1e-8));
}

}  // namespace
}  // namespace limber::bullet::test
