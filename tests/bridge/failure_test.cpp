#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// What goes wrong inside of Bullet's step is told afterwards; the world lives on.

namespace limber::bullet::test {
namespace {

PhysicalModel soft_block(const std::string& name, const Vec3& centre, const Vec3& velocity) {
  PhysicalModel model = make_block({.cells = {2, 2, 2}, .modulus = 1e6}, centre, velocity);
  model.name = name;
  return model;
}

void expect_world_goes_on(World& world) {
  btRigidBody& box = world.add_box({0.1, 0.1, 0.1}, 1.0, {3.0, 10.0, 0.0});
  world.run(0.2, kTick);
  EXPECT_LT(box.getLinearVelocity().y(), -1.5);
}

TEST(Failure, OfABlowUpNamesTheObject) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(soft_block("calm one", {2.0, 1.0, 0.0}, Vec3::Zero()));
  PhysicalModel model = soft_block("wild one", {0.0, 1.0, 0.0}, Vec3::Zero());
  model.points[PointId(std::size_t{0})].velocity.x() = 1e300;
  simulation.add(std::move(model));
  EXPECT_FALSE(simulation.failure());
  world.step(kTick);
  ASSERT_TRUE(simulation.failure());
  EXPECT_NE(simulation.failure()->where.find("wild one"), std::string::npos)
      << simulation.failure()->text();
  expect_world_goes_on(world);
}

TEST(Failure, OfTooManySubstepsNamesTheObjectAndTheSetting) {
  World world;
  CoSimulationSettings settings = settings_for(Representation::kAlwaysFlexible);
  settings.most_substeps = 3;
  CoSimulation simulation(*world, settings);
  simulation.add(soft_block("stiff one", {0.0, 1.0, 0.0}, Vec3::Zero()));
  world.step(kTick);
  ASSERT_TRUE(simulation.failure());
  EXPECT_EQ(simulation.failure()->where, "stiff one");
  EXPECT_NE(simulation.failure()->remedy.find("most_substeps"), std::string::npos);
  expect_world_goes_on(world);
}

// The limit is the stiffest object's, and so must be the name.
TEST(Failure, OfTooManySubstepsNamesTheObjectThatNeedsThem) {
  World world;
  CoSimulationSettings settings = settings_for(Representation::kAlwaysFlexible);
  settings.most_substeps = 60;
  CoSimulation simulation(*world, settings);
  simulation.add(soft_block("soft one", {2.0, 1.0, 0.0}, Vec3::Zero()));
  PhysicalModel stiff = make_block({.cells = {2, 2, 2}, .modulus = 1e10}, {0.0, 1.0, 0.0});
  stiff.name = "stiff one";
  simulation.add(std::move(stiff));
  world.step(kTick);
  ASSERT_TRUE(simulation.failure());
  EXPECT_EQ(simulation.failure()->where, "stiff one");
}

TEST(Settings, OutOfRangeAreRefused) {
  World world;
  const double nan = std::nan("");
  for (const CoSimulationSettings& wrong :
       {CoSimulationSettings{.step_scale = 0.0}, CoSimulationSettings{.step_scale = nan},
        CoSimulationSettings{.most_substeps = 0}, CoSimulationSettings{.debris_lifetime = -1.0},
        CoSimulationSettings{.debris_lifetime = nan}}) {
    EXPECT_THROW(CoSimulation(*world, wrong), InputError);
  }
}

}  // namespace
}  // namespace limber::bullet::test
