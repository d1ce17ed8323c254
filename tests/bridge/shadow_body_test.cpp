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

TEST(Shadow, RemembersThatItWasPushed) {
  World world;
  ShadowBody shadow = moving_shadow(world);
  EXPECT_FALSE(shadow.touched);
  shadow.add_force({30.0, -20.0, 10.0}, shadow.position);
  EXPECT_TRUE(shadow.touched);
}

// Pushed at every substep, for a tick in which Bullet turns the body by a quarter of a radian.
ShadowBody pushed_for_a_tick(World& world) {
  ShadowBody shadow = moving_shadow(world);
  for (int n = 0; n < 64; ++n) {
    shadow.apply_impulse({0.01 * n, -0.02, 0.03}, shadow.position + Vec3(0.1, 0.0, 0.1));
    advance_pose(shadow, kTick / 64);
  }
  return shadow;
}

// Bullet moves the body straight at its final velocity, with its own exponential map; the
// correction puts it where the shadow is. Bullet's gyroscopic torque, on by default, stays out.
TEST(Shadow, CorrectedBodyIsWhereTheShadowIs) {
  World world(0.0);
  ShadowBody shadow = pushed_for_a_tick(world);
  EXPECT_NE(shadow.body->getFlags(), 0);
  write_velocity(shadow, shadow.velocity);
  world.step(kTick);
  correct_pose(shadow, kTick);
  const btTransform& pose = shadow.body->getWorldTransform();
  EXPECT_LT((from_bullet(pose.getOrigin()) - shadow.position).norm(), by_precision(1e-6, 1e-14));
  EXPECT_LT(from_bullet(pose.getRotation()).angularDistance(shadow.orientation),
            by_precision(1e-6, 1e-14));
  EXPECT_LT((from_bullet(shadow.body->getAngularVelocity()) - shadow.angular_velocity).norm(),
            by_precision(1e-6, 1e-14));
}

// In single precision a spin of 1 rad/s is off by 3e-8 rad/s when it is written.
TEST(Shadow, GoesOnUnroundedWhereItsBodyWasLeft) {
  World world(0.0);
  ShadowBody shadow = pushed_for_a_tick(world);
  write_velocity(shadow, shadow.velocity);
  world.step(kTick);
  correct_pose(shadow, kTick);
  ShadowBody next = make_shadow(*shadow.body);
  go_on_from(next, shadow);
  EXPECT_EQ(next.position, shadow.position);
  EXPECT_EQ(next.orientation.coeffs(), shadow.orientation.coeffs());
  EXPECT_EQ(next.velocity, shadow.velocity);
  EXPECT_EQ(next.angular_velocity, shadow.angular_velocity);
}

// What the game or Bullet's solver did since counts.
TEST(Shadow, GoesOnFromItsBodyWhereThatWasPushedOrPut) {
  const btVector3 other(7, 8, 9);
  for (bool pushed : {true, false}) {
    World world(0.0);
    ShadowBody shadow = pushed_for_a_tick(world);
    write_velocity(shadow, shadow.velocity);
    world.step(kTick);
    correct_pose(shadow, kTick);
    if (pushed) shadow.body->setLinearVelocity(other);
    if (!pushed) shadow.body->getWorldTransform().setOrigin(other);
    const ShadowBody fresh = make_shadow(*shadow.body);
    ShadowBody next = fresh;
    go_on_from(next, shadow);
    EXPECT_EQ(next.position, fresh.position);
    EXPECT_EQ(next.velocity, fresh.velocity);
    EXPECT_EQ(next.velocity == from_bullet(other), pushed);
    EXPECT_EQ(next.position == from_bullet(other), !pushed);
  }
}

TEST(Shadow, LeavesTheBodysFlagsAsTheyWere) {
  World world(0.0);
  ShadowBody shadow = pushed_for_a_tick(world);
  const int flags = shadow.body->getFlags();
  write_velocity(shadow, shadow.velocity);
  world.step(kTick);
  correct_pose(shadow, kTick);
  EXPECT_EQ(shadow.body->getFlags(), flags);
}

// 60 rad/s: Bullet turns no body by more than an eighth of a turn a tick.
TEST(Shadow, FastSpinIsNotCutByBullet) {
  World world(0.0);
  btRigidBody& body = world.add_box({0.1, 0.2, 0.3}, 3.0, Vec3::Zero());
  body.setAngularVelocity(btVector3(0, 60, 0));
  ShadowBody shadow = make_shadow(body);
  advance_pose(shadow, kTick);
  write_velocity(shadow, shadow.velocity);
  world.step(kTick);
  correct_pose(shadow, kTick);
  const Eigen::Quaterniond exact(Eigen::AngleAxisd(60.0 * kTick, Vec3::UnitY()));
  EXPECT_LT(from_bullet(body.getWorldTransform().getRotation()).angularDistance(exact),
            by_precision(1e-5, 1e-12));
}

}  // namespace
}  // namespace limber::bullet::test
