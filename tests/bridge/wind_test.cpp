#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/wind_models.h"
#include "tests/bridge/world.h"

// A rigid proxy feels the wind that its lattice would: followed in both representations, a leaf and
// a plank land in the same place.

namespace limber::bullet::test {
namespace {

constexpr double kFlight = 1.0;  // s

// Where every point is in the end.
std::vector<Vec3> landing(const PhysicalModel& model, Representation as, double step_scale) {
  World world;
  CoSimulation simulation(*world, settings_for(as, step_scale));
  simulation.set_air(gusting_air());
  simulation.add(model);
  world.run(kFlight, kTick);
  EXPECT_FALSE(simulation.failure());
  const PhysicalModel end = simulation.model(0);
  return {end.geometry.points.begin(), end.geometry.points.end()};
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double distance = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) distance = std::max(distance, (a[i] - b[i]).norm());
  return distance;
}

class Wind : public testing::TestWithParam<PhysicalModel (*)()> {};

// Symplectic Euler is of first order: what halving the substep changes is half of the error at the
// full one.
TEST_P(Wind, BlowsAProxyToWhereItsLatticeGoes) {
  const PhysicalModel model = GetParam()();
  const auto rigid = landing(model, Representation::kAlwaysRigid, 1.0);
  const auto coarse = landing(model, Representation::kAlwaysFlexible, 0.5);
  const auto fine = landing(model, Representation::kAlwaysFlexible, 0.25);
  const double integrator_error = 2.0 * farthest(coarse, fine);
  // m: what a second of Bullet's floats costs, and what bending still makes of it.
  const double stored = by_precision(1e-4, 1e-5);
  EXPECT_LT(farthest(rigid, coarse), 1.2 * integrator_error + stored);
  EXPECT_LT(farthest(rigid, fine), 0.6 * integrator_error + stored);
}

// Otherwise the test above would compare two vacuums.
TEST_P(Wind, MattersInThisTest) {
  const PhysicalModel model = GetParam()();
  World world;
  CoSimulation vacuum(*world, settings_for(Representation::kAlwaysRigid));
  vacuum.add(model);
  world.run(kFlight, kTick);
  const PhysicalModel fallen = vacuum.model(0);
  const auto blown = landing(model, Representation::kAlwaysRigid, 1.0);
  EXPECT_GT(farthest(blown, {fallen.geometry.points.begin(), fallen.geometry.points.end()}), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Things, Wind, testing::Values(leaf, plank),
                         [](const auto& thing) { return thing.index == 0 ? "Leaf" : "Plank"; });

TEST(Wind, WakesAPlankThatFellAsleep) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysRigid));
  PhysicalModel model = plank();
  place(model, Mat3::Identity(), {0.0, -2.97, 0.0});
  for (PointAttributes& point : model.points) point.velocity.setZero();
  simulation.add(model);
  world.run(4.0, kTick);
  const Vec3 asleep = simulation.placement(0).second;
  world.run(1.0, kTick);
  EXPECT_EQ((simulation.placement(0).second - asleep).norm(), 0.0);
  FlowPrimitive storm;
  storm.strength = 25.0;
  simulation.set_air(Air{.wind = {{storm}}});
  world.run(1.0, kTick);
  EXPECT_GT(simulation.placement(0).second.x() - asleep.x(), 0.2);
}

// A limp panel of 50 g, lying flat in the air, that its own drag may not bend when it is rigid: a
// sustained load of its weight strains it by more than the 1 % that a player would see.
PhysicalModel panel() {
  PhysicalModel model = make_block({.cells = {6, 1, 6},
                                    .spacing = 0.05,
                                    .mass = 0.05,
                                    .modulus = 3e3,
                                    .strain_at_break = 0.02,
                                    .damping_ratio = 0.2,
                                    .internal_damping = 30.0},
                                   {0.0, 300.0, 0.0});
  give_drag(model, 1.2, 0.05);
  return model;
}

// The air that bends a lattice is in the shape of the body it becomes, and strains that no more.
TEST(Wind, ThatStaysTheSameLeavesAPieceRigid) {
  World world;
  CoSimulation simulation(*world);
  simulation.set_air(Air{});
  simulation.add(panel());
  world.run(3.0, kTick);  // falls at its terminal speed, 1.9 m/s, after one
  const std::size_t thawed = simulation.counters().to_flexible;
  EXPECT_GT(thawed, 0u);
  EXPECT_LT(thawed, 5u);
  world.run(2.0, kTick);
  EXPECT_EQ(simulation.counters().to_flexible, thawed);
}

// Once it is gone it loads nothing: the piece relaxes, and that is all.
TEST(Wind, ThatEndsLoadsNothingAnyMore) {
  World world(0.0);
  CoSimulation simulation(*world);
  simulation.set_air(Air{.wind = {{uniform_flow({0.0, 3.0, 0.0})}}});
  simulation.add(panel());
  world.run(0.1, kTick);
  EXPECT_GT(simulation.counters().to_flexible, 0u);
  simulation.set_air(std::nullopt);
  world.run(1.0, kTick);
  const std::size_t thawed = simulation.counters().to_flexible;
  world.run(2.0, kTick);
  EXPECT_EQ(simulation.counters().to_flexible, thawed);
  EXPECT_FALSE(simulation.pieces().at(0).flexible);
}

// Bullet gave sleepers no gravity in the step in which they wake.
TEST(Wind, WakesAStackWithoutAKick) {
  World world;
  world.add_ground();
  world->getSolverInfo().m_splitImpulsePenetrationThreshold = btScalar(-0.04);  // Bullet's default
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysRigid));
  const Block tile{.cells = {4, 2, 4}, .spacing = 0.05, .mass = 0.15, .modulus = 2e8};
  for (double height : {0.05, 0.15, 0.25}) simulation.add(make_block(tile, {0.0, height, 0.0}));
  PhysicalModel sail = make_block(tile, {0.0, 0.35, 0.0});
  give_drag(sail, 1.2, 0.0);
  simulation.add(sail);
  world.run(20.0, kTick);
  const btCollisionObject* top = world->getCollisionObjectArray()[4];
  ASSERT_FALSE(top->isActive());
  // 0.26 N from the side: more than a tenth of the 1.5 N that it weighs, less than friction bears.
  simulation.set_air(Air{.wind = {{uniform_flow({3.0, 0.0, 0.0})}}});
  double fastest = 0.0;
  for (int tick = 0; tick < 6; ++tick) {  // later the stack gives way
    world.step(kTick);
    for (const PieceView& piece : simulation.pieces()) {
      fastest = std::max(fastest, std::abs(piece.motion.velocity.y()));
    }
  }
  EXPECT_TRUE(top->isActive());
  EXPECT_LT(fastest, 5e-3);  // m/s
}

TEST(Wind, IsRefusedWhenItHasNoDirection) {
  World world;
  CoSimulation simulation(*world);
  FlowPrimitive nowhere;
  nowhere.direction.setZero();
  EXPECT_THROW(simulation.set_air(Air{.wind = {{nowhere}}}), InputError);
  EXPECT_FALSE(simulation.air());
}

}  // namespace
}  // namespace limber::bullet::test
