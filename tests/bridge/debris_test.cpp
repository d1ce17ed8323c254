#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

// An impact presses the lowest points into the floor before they break off. Rays that started there
// would miss it, and what they stand for would fall for ever.
TEST(Debris, BornInsideOfTheFloorComesToRestOnIt) {
  World world;
  world.add(std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), 0.0,
            Vec3::Zero());
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block({.cells = {6, 4, 4},
                             .spacing = 0.05,
                             .modulus = 2e7,
                             .strain_at_break = 0.005,
                             .damping_ratio = 0.2},
                            {0.0, 0.4, 0.0}, {0.0, -6.0, 0.0}, {0.0, 0.0, 8.0}));
  world.run(1.5, kTick);
  ASSERT_FALSE(simulation.failure());
  ASSERT_GT(simulation.debris_mass(0), 0.0);
  double lowest = 1.0;
  for (const Vec3& p : simulation.model(0).geometry.points) lowest = std::min(lowest, p.y());
  EXPECT_GT(lowest, -0.01);  // pieces on contact springs sink by millimetres
}

}  // namespace
}  // namespace limber::bullet::test
