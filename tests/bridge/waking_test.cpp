#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Sleeping bodies of Bullet's that a lattice hits.

namespace limber::bullet::test {
namespace {

void run_until_asleep(World& world) {
  for (int tick = 0; tick < 600; ++tick) world.step(kTick);
  for (const auto& body : world.bodies()) ASSERT_FALSE(body->isActive()) << "still awake";
}

double fastest(const std::vector<btRigidBody*>& boxes) {
  double speed = 0.0;
  for (const btRigidBody* box : boxes) {
    speed = std::max(speed, static_cast<double>(box->getLinearVelocity().length()));
  }
  return speed;
}

TEST(SleepingBox, IsWokenAndKnockedOver) {
  World world;
  world.add_ground();
  btRigidBody& box = world.add_box({0.1, 0.5, 0.1}, 5.0, {0.0, 0.5, 0.0});  // wood, 250 kg/m^3
  run_until_asleep(world);
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block({.modulus = 5e6}, {-0.5, 0.8, 0.0}, {5.0, 0.0, 0.0}));
  world.run(0.2, kTick);
  EXPECT_TRUE(box.isActive());
  EXPECT_GT(box.getLinearVelocity().x(), 0.5);
  world.run(1.0, kTick);
  EXPECT_FALSE(simulation.failure());
  EXPECT_LT(box.getWorldTransform().getBasis()[1][1], 0.5);  // leans by more than 60 degrees
}

// A stack of five, asleep; its boxes from the bottom.
std::vector<btRigidBody*> sleeping_stack(World& world) {
  world.add_ground();
  // Bullet's default: small overlaps are mended with velocity, which lets the stack settle tighter.
  world->getSolverInfo().m_splitImpulsePenetrationThreshold = btScalar(-0.04);
  std::vector<btRigidBody*> boxes;
  for (int i = 0; i < 5; ++i) {
    boxes.push_back(&world.add_box(Vec3::Constant(0.2), 2.0, {0.0, 0.2 + 0.4 * i, 0.0}));
  }
  run_until_asleep(world);
  return boxes;
}

// What Bullet does to the stack when a game wakes it: the measure for the next test.
double fastest_when_woken_by_hand() {
  World world;
  const auto boxes = sleeping_stack(world);
  for (btRigidBody* box : boxes) box->activate(true);
  double most = 0.0;
  for (int tick = 0; tick < 60; ++tick) {
    world.step(kTick);
    most = std::max(most, fastest(boxes));
  }
  return most;
}

// 5 g that arrive at 1 cm/s: 5e-5 N s, and 0.05 N of weight.
TEST(SleepingStack, OfFiveWokenGentlyMovesNoMoreThanWhenAGameWakesIt) {
  World world;
  const auto boxes = sleeping_stack(world);
  const Block feather{.cells = {2, 2, 2}, .spacing = 0.05, .mass = 0.005, .modulus = 1e4};
  const double top = boxes[4]->getWorldTransform().getOrigin().y() + 0.2;
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block(feather, {0.0, top + 0.0501, 0.0}, {0.0, -0.01, 0.0}));
  double most = 0.0;
  bool woken = false;
  for (int tick = 0; tick < 60; ++tick) {
    world.step(kTick);
    most = std::max(most, fastest(boxes));
    woken = woken || boxes[0]->isActive();
  }
  EXPECT_FALSE(simulation.failure());
  EXPECT_TRUE(woken);
  EXPECT_LT(most, fastest_when_woken_by_hand());
  EXPECT_LT(most, 0.01);  // without gravity for the woken it would be 0.085
}

// A rigid piece that bears one and a half times its weight, asleep. It strains it by 0.6 %, 1 %
// would make it flexible, and twice the impulse of a tick would look like a touch. A feather that
// lands on the weight as a lattice wakes both.
TEST(SleepingPiece, BearsNoMoreWhenItWakes) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world);
  simulation.add(make_block({.modulus = 1e6}, {0.0, 0.15, 0.0}));
  btRigidBody& weight = world.add_box({0.15, 0.1, 0.15}, 12.0, {0.0, 0.4, 0.0});
  world.run(6.0, kTick);
  const btRigidBody& body = *simulation.pieces().at(0).body;
  ASSERT_FALSE(body.isActive());
  ASSERT_FALSE(weight.isActive());
  const auto thaws = [&] {
    const auto& switches = simulation.switches();
    return std::count_if(switches.begin(), switches.end(), [](const SwitchRecord& r) {
      return r.object == 0 && r.books.to_flexible;
    });
  };
  const auto before = thaws();
  const Block feather{.cells = {2, 2, 2}, .spacing = 0.05, .mass = 0.005, .modulus = 1e4};
  simulation.add(make_block(feather, {0.0, 0.5 + 0.05 + 0.03, 0.0}, {0.0, -1.0, 0.0}));
  simulation.add(make_block({.modulus = 1e6}, {50.0, 100.0, 0.0}));  // another piece is awake
  bool woken = false;
  for (int tick = 0; tick < 30; ++tick) {
    world.step(kTick);
    woken = woken || body.isActive();
  }
  EXPECT_TRUE(woken);
  EXPECT_EQ(thaws(), before);
}

// A lattice that passes by wakes nobody.
TEST(SleepingBox, SleepsOnWhileALatticePasses) {
  World world;
  world.add_ground();
  btRigidBody& box = world.add_box(Vec3::Constant(0.2), 5.0, {0.0, 0.2, 0.0});
  run_until_asleep(world);
  const btTransform before = box.getWorldTransform();
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block({.modulus = 5e6}, {-1.0, 0.7, 0.0}, {6.0, 1.0, 0.0}));
  world.run(0.35, kTick);
  EXPECT_FALSE(box.isActive());
  EXPECT_TRUE(box.getWorldTransform() == before);
}

}  // namespace
}  // namespace limber::bullet::test
