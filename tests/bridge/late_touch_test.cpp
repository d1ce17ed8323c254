#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Touches that Bullet's solver brings about within a tick: what is hit becomes a lattice after the
// others have gone through the tick.

namespace limber::bullet::test {
namespace {

// c = 58 m/s: a touch of 0.58 m/s by something heavy makes it flexible.
constexpr Block kSoft = {.modulus = 1e6};

bool is_late(const SwitchRecord& record) {
  return std::any_of(record.numbers.begin(), record.numbers.end(),
                     [](const auto& number) { return number.first == "deflected"; });
}

std::size_t late_thaws(const CoSimulation& simulation) {
  return static_cast<std::size_t>(
      std::count_if(simulation.switches().begin(), simulation.switches().end(), is_late));
}

btRigidBody& add_ball(World& world, double radius, double mass, const Vec3& at,
                      const Vec3& velocity = Vec3::Zero()) {
  btRigidBody& ball = world.add(std::make_unique<btSphereShape>(btScalar(radius)), mass, at);
  ball.setLinearVelocity(to_bullet(velocity));
  ball.setRestitution(btScalar(0.5));
  return ball;
}

// A block strikes another one. Far away, in the middle of that, a light ball stands a centimetre
// off a rigid block, and a heavy one knocks it on to that in one tick, or does not.
struct Strike {
  std::vector<Vec3> points;  // of the two, m
  std::size_t late = 0;
};

Strike strike(bool knocked) {
  World world(0.0);
  CoSimulation simulation(*world);
  const Block block = {.modulus = 1e5};  // they press one another for four ticks
  simulation.add(make_block(block, Vec3::Zero()));
  simulation.add(make_block(block, {0.305, 0.05, 0.02}, {-1.0, 0.0, 0.0}));
  // Softer: all have the step of the stiffest, and it is not to be this one, however strained.
  simulation.add(make_block({.modulus = 1e4}, {50.0, 0.0, 0.0}));
  add_ball(world, 0.05, 1.0, {50.0 - 0.15 - 0.05 - 0.01, 0.0, 0.0});
  // Bullet finds balls in contact once they overlap: at the start of the third tick.
  const double away = 6.0 * 2.0 * kTick - 0.002;
  const Vec3 heavy(50.0 - 0.15 - 0.1 - 0.01 - 0.1 - away, 0.0, 0.0);
  add_ball(world, 0.1, 50.0, heavy, {knocked ? 6.0 : -6.0, 0.0, 0.0});
  Strike result;
  for (int tick = 0; tick < 8; ++tick) world.step(kTick);
  EXPECT_FALSE(simulation.failure());
  for (std::size_t object : {0, 1}) {
    const PhysicalModel model = simulation.model(object);
    result.points.insert(result.points.end(), model.geometry.points.begin(),
                         model.geometry.points.end());
  }
  result.late = late_thaws(simulation);
  return result;
}

TEST(LateTouch, LeavesTheContactsOfOthersAlone) {
  const Strike knocked = strike(true), calm = strike(false);
  ASSERT_EQ(knocked.late, 1u);
  ASSERT_EQ(calm.late, 0u);
  double farthest = 0.0;
  for (std::size_t p = 0; p < calm.points.size(); ++p) {
    farthest = std::max(farthest, (knocked.points[p] - calm.points[p]).norm());
  }
  EXPECT_EQ(farthest, 0.0);
}

// Two planks are knocked on to two blocks, which meet within that tick and press one another to
// half of their size. What their contact knows has to last, or they stay inside of one another (at
// 0.16 to 0.19 m, measured).
TEST(LateTouch, OfTwoPiecesThatMeetGoesOn) {
  World world(0.0);
  CoSimulation simulation(*world);
  for (double side : {-1.0, 1.0}) {
    simulation.add(make_block({.modulus = 3e6}, {side * 0.155, 0.0, 0.0}));
    world.add_box({0.03, 0.15, 0.15}, 4.0, {side * (0.305 + 0.005 + 0.03), 0.0, 0.0});
    add_ball(world, 0.1, 50.0, {side * (0.305 + 0.005 + 0.06 + 0.1 - 0.001), 0.0, 0.0},
             {-side * 3.0, 0.0, 0.0});
  }
  double apart = 0.0, nearest = 1.0;  // m, their centres
  for (int tick = 0; tick < 60; ++tick) {
    world.step(kTick);
    apart = (sums_of(simulation.model(1)).centre() - sums_of(simulation.model(0)).centre()).x();
    nearest = std::min(nearest, apart);
  }
  ASSERT_FALSE(simulation.failure());
  ASSERT_EQ(late_thaws(simulation), 2u);
  EXPECT_LT(nearest, 0.22);
  EXPECT_GT(apart, 0.25);
}

// Gravity of 10 g, and a block 35 mm above a floor. A heavy ball that touches it gives it 0.2 m/s
// within the tick: with the 1.6 m/s of gravity, which the solver has given by then, it comes 31 mm
// far. Were the tick's gravity counted once more it would touch (45 mm).
TEST(LateTouch, IsForeseenWithTheGravityOfOneTick) {
  World world(10.0 * kGravity);
  world.add_box({5.0, 0.5, 5.0}, 0.0, {0.0, -0.5, 0.0});
  CoSimulation simulation(*world);
  simulation.add(make_block(kSoft, {0.0, 0.15 + 0.035, 0.0}));
  add_ball(world, 0.1, 50.0, {0.0, 0.3 + 0.035 + 0.1 + 0.001, 0.0}, {0.0, -0.3, 0.0});
  world.step(kTick);
  const RigidMotion motion = simulation.pieces().at(0).motion;
  ASSERT_LT(motion.velocity.y(), -10.0 * kGravity * kTick - 0.1);  // deflected
  EXPECT_FALSE(simulation.pieces().at(0).flexible);
  world.step(kTick);
  EXPECT_TRUE(simulation.pieces().at(0).flexible);
  EXPECT_EQ(late_thaws(simulation), 0u);
}

// A sleeping block has had no gravity in the tick in which it is hit: taking that off would throw
// it up by g dt, 1.4 mm in the tick.
TEST(LateTouch, OfASleepingPieceDoesNotLiftIt) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world);
  simulation.add(make_block(kSoft, {0.0, 0.15, 0.0}));
  btRigidBody& light = add_ball(world, 0.1, 1.0, {-0.15 - 0.1 - 0.01, 0.1, 0.0});
  world.run(5.0, kTick);
  ASSERT_FALSE(simulation.pieces().at(0).body->isActive());
  ASSERT_FALSE(light.isActive());
  const double before = sums_of(simulation.model(0)).centre().y();
  const Vec3 at = from_bullet(light.getWorldTransform().getOrigin());
  add_ball(world, 0.1, 50.0, at - Vec3(0.199, 0.0, 0.0), {6.0, 0.0, 0.0});
  world.step(kTick);
  ASSERT_EQ(late_thaws(simulation), 1u);
  EXPECT_LT(sums_of(simulation.model(0)).centre().y(), before + 1e-4);
}

// A plank that a lattice pushes before Bullet solves, and another one after: while they do, its
// gyroscopic flags are off, and then they are the game's again.
TEST(LateTouch, GivesBodiesTheirFlagsBack) {
  World world(0.0);
  CoSimulation simulation(*world);
  btRigidBody& plank = world.add_box({0.05, 0.6, 0.3}, 10.0, Vec3::Zero());
  const int flags = plank.getFlags();
  ASSERT_NE(flags, 0);
  simulation.add(make_block(kSoft, {-0.05 - 0.15 - 0.01, -0.4, 0.0}, {4.0, 0.0, 0.0}));
  simulation.add(make_block(kSoft, {0.05 + 0.15 + 0.03, 0.4, 0.0}));
  add_ball(world, 0.1, 50.0, {-0.05 - 0.1 + 0.001, 0.3, 0.0}, {5.0, 0.0, 0.0});
  world.step(kTick);
  ASSERT_EQ(simulation.counters().to_flexible, 2u);
  ASSERT_EQ(late_thaws(simulation), 1u);
  EXPECT_GT(sums_of(simulation.model(1)).momentum.x(), 1.0);
  EXPECT_EQ(plank.getFlags(), flags);
}

}  // namespace
}  // namespace limber::bullet::test
