#include <gtest/gtest.h>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Bodies that Bullet lets move along or turn about some axes alone (linear and angular factors).

namespace limber::bullet::test {
namespace {

// A block that hits the end of a free box off its middle, without gravity.
struct Hit {
  Vec3 velocity, angular_velocity;  // of the box afterwards
  double energy_start = 0.0, energy_end = 0.0;
  double height = 0.0;  // m, of the block above the box's middle just after the hit
};

Hit hit(const Vec3& linear_factor, const Vec3& angular_factor) {
  World world(0.0);
  btRigidBody& box = world.add_box({0.3, 0.1, 0.1}, 5.0, Vec3::Zero());
  box.setLinearFactor(to_bullet(linear_factor));
  box.setAngularFactor(to_bullet(angular_factor));
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  PhysicalModel block = make_block({.modulus = 2e6}, {0.25, 0.27, 0.05});
  set_in_motion(block, {0.5, -2.0, 0.7}, Vec3::Zero());
  Hit result;
  result.energy_start = sums_of(block).kinetic;
  simulation.add(block);
  world.run(0.1, kTick);
  result.height =
      sums_of(simulation.model(0)).centre().y() - box.getWorldTransform().getOrigin().y();
  world.run(0.4, kTick);
  EXPECT_FALSE(simulation.failure());
  const Sums of_block = sums_of(simulation.model(0));
  result.velocity = from_bullet(box.getLinearVelocity());
  result.angular_velocity = from_bullet(box.getAngularVelocity());
  result.energy_end = of_block.kinetic + of_block.elastic + sums_of(box).kinetic;
  return result;
}

TEST(LockedAxes, NoneLocked) {
  const Hit free = hit(Vec3::Ones(), Vec3::Ones());
  EXPECT_LT(free.velocity.y(), -0.1);
  EXPECT_GT(free.angular_velocity.norm(), 0.1);
}

TEST(LockedAxes, ABodyThatMayNotTurnDoesNot) {
  const Hit upright = hit(Vec3::Ones(), Vec3::Zero());
  EXPECT_LT(upright.velocity.y(), -0.1);
  EXPECT_EQ(upright.angular_velocity, Vec3::Zero());
  EXPECT_LE(upright.energy_end, upright.energy_start);
}

TEST(LockedAxes, ABodyOnAPlaneStaysThere) {
  const Hit flat = hit({1.0, 1.0, 0.0}, Vec3::UnitZ());
  EXPECT_LT(flat.velocity.y(), -0.1);
  EXPECT_EQ(flat.velocity.z(), 0.0);
  EXPECT_LT(flat.angular_velocity.z(), -0.1);
  EXPECT_EQ(flat.angular_velocity.x(), 0.0);
  EXPECT_EQ(flat.angular_velocity.y(), 0.0);
  EXPECT_LE(flat.energy_end, flat.energy_start);
}

TEST(LockedAxes, ABodyThatMayNotMoveBearsWhatFallsOnIt) {
  const Hit post = hit(Vec3::Zero(), Vec3::Zero());
  EXPECT_EQ(post.velocity, Vec3::Zero());
  EXPECT_EQ(post.angular_velocity, Vec3::Zero());
  // Half the box and half the block are 0.25; without contact it would be at 0.07, and on a box
  // that gives way it is at 0.13.
  EXPECT_GT(post.height, 0.19);
  EXPECT_LE(post.energy_end, post.energy_start);
}

}  // namespace
}  // namespace limber::bullet::test
