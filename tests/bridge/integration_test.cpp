#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Lattices beside Bullet by implicit Euler, and by both methods in one world.

namespace limber::bullet::test {
namespace {

using testing::HasSubstr;

CoSimulationSettings flexible(Integration integration, int most_substeps = 100000) {
  CoSimulationSettings settings = settings_for(Representation::kAlwaysFlexible);
  settings.integration = integration;
  settings.most_substeps = most_substeps;
  return settings;
}

// J, of the points of one object against the floor.
double energy_of(const PhysicalModel& model) {
  double energy = 0.0;
  for (PointId p : ids_of(model.points)) {
    energy += model.points[p].mass * (0.5 * model.points[p].velocity.squaredNorm() +
                                      kGravity * model.geometry.points[p].y());
  }
  return energy;
}

// 8 kg of 2e10 Pa would take some ten thousand explicit substeps a tick.
TEST(Integration, ImplicitBlockOfSteelLandsAndComesToRest) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, flexible(Integration::kImplicit));
  simulation.add(make_block({.modulus = 2e10}, {0.0, 0.4, 0.0}));
  const double start = energy_of(simulation.model(0));
  double highest = 0.0;
  for (int tick = 0; tick < 120; ++tick) {
    world.step(kTick);
    ASSERT_FALSE(simulation.failure()) << simulation.failure()->text();
    highest = std::max(highest, energy_of(simulation.model(0)));
  }
  EXPECT_LE(highest, start * (1.0 + by_precision(1e-5, 1e-9)));
  const PhysicalModel end = simulation.model(0);
  EXPECT_NEAR(centre_of_mass(end).y(), 0.15, 2e-3);
  for (const PointAttributes& point : end.points) EXPECT_LT(point.velocity.norm(), 0.02);
}

TEST(Integration, AutomaticMakesTheStiffOneImplicitAndSaysSo) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, flexible(Integration::kAutomatic, 2000));
  PhysicalModel soft = make_block({.modulus = 2e6}, {2.0, 0.3, 0.0});
  PhysicalModel stiff = make_block({.modulus = 2e11}, {0.0, 0.3, 0.0});
  stiff.name = "anvil";
  simulation.add(soft);
  simulation.add(stiff);
  world.run(0.5, kTick);
  ASSERT_FALSE(simulation.failure()) << simulation.failure()->text();
  ASSERT_EQ(simulation.notes().size(), 1u);
  EXPECT_EQ(simulation.notes()[0].where, "anvil");
  EXPECT_THAT(simulation.notes()[0].what, HasSubstr("implicitly"));
}

TEST(Integration, AutomaticLeavesWhatIsAffordableAlone) {
  World world, other;
  CoSimulation automatic(*world, flexible(Integration::kAutomatic));
  CoSimulation explicit_only(*other, flexible(Integration::kExplicit));
  for (CoSimulation* simulation : {&automatic, &explicit_only}) {
    simulation->add(make_block({}, {0.0, 1.0, 0.0}, Vec3::Zero(), {0.0, 2.0, 1.0}));
  }
  world.run(0.2, kTick);
  other.run(0.2, kTick);
  EXPECT_TRUE(automatic.notes().empty());
  EXPECT_EQ(automatic.state_hash(), explicit_only.state_hash());
}

// Both methods are first order in free fall: the same parabola.
TEST(Integration, ImplicitFallsLikeExplicit) {
  World world, other;
  CoSimulation implicit_only(*world, flexible(Integration::kImplicit));
  CoSimulation explicit_only(*other, flexible(Integration::kExplicit));
  for (CoSimulation* simulation : {&implicit_only, &explicit_only}) {
    simulation->add(make_block({}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}));
  }
  world.run(0.3, kTick);
  other.run(0.3, kTick);
  const Vec3 a = centre_of_mass(implicit_only.model(0));
  const Vec3 b = centre_of_mass(explicit_only.model(0));
  // g t dt / 2 of either step lies between them.
  EXPECT_LT((a - b).norm(), 0.5 * kGravity * 0.3 * kTick);
  EXPECT_NEAR(a.x(), b.x(), 1e-6);
}

// Each object by its own method, whatever the settings say.
TEST(Integration, IsChosenPerObject) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, flexible(Integration::kExplicit, 2000));
  PhysicalModel anvil = make_block({.modulus = 2e11}, {0.0, 0.3, 0.0});
  anvil.name = "anvil";
  simulation.add(make_block({.modulus = 2e6}, {2.0, 0.3, 0.0}));
  simulation.add(anvil, Integration::kImplicit);
  world.run(0.5, kTick);
  ASSERT_FALSE(simulation.failure()) << simulation.failure()->text();
  EXPECT_TRUE(simulation.notes().empty());
  EXPECT_LT(centre_of_mass(simulation.model(1)).y(), 0.2);  // on the floor
}

// Neither the implicit one, which is stiffer, nor what would not help is named.
TEST(Integration, RefusalNamesTheExplicitOneThatIsTooStiff) {
  World world;
  CoSimulation simulation(*world, flexible(Integration::kImplicit, 500));
  PhysicalModel anvil = make_block({.modulus = 2e12}, {0.0, 2.0, 0.0});
  PhysicalModel spring = make_block({.modulus = 2e11}, {5.0, 2.0, 0.0});
  anvil.name = "anvil";
  spring.name = "bar";
  simulation.add(anvil);
  simulation.add(spring, Integration::kExplicit);
  world.run(0.1, kTick);
  ASSERT_TRUE(simulation.failure());
  EXPECT_EQ(simulation.failure()->where, "bar");
  EXPECT_THAT(simulation.failure()->remedy, HasSubstr("implicitly"));
}

}  // namespace
}  // namespace limber::bullet::test
