#include <gtest/gtest.h>

#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Bodies that lie on one another and on a lattice: it is the lattice alone that bears them.

namespace limber::bullet::test {
namespace {

class StackOnALattice : public testing::TestWithParam<double> {};  // mass of a box, kg

TEST_P(StackOnALattice, IsBorneByIt) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block({.modulus = 1e6, .internal_damping = 100.0}, {0.0, 0.15, 0.0}));
  btRigidBody* boxes[3];
  for (int i = 0; i < 3; ++i) {
    boxes[i] = &world.add_box(Vec3::Constant(0.1), GetParam(), {0.0, 0.4 + 0.2 * i, 0.0});
  }
  world.run(2.0, kTick);
  const double early = boxes[0]->getWorldTransform().getOrigin().y();
  world.run(3.0, kTick);
  ASSERT_FALSE(simulation.failure());
  const double late = boxes[0]->getWorldTransform().getOrigin().y();
  EXPECT_GT(late, 0.4 - 0.03);
  EXPECT_NEAR(late, early, 1e-3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(boxes[i]->getLinearVelocity().length(), 0.02) << i;
    EXPECT_NEAR(boxes[i]->getWorldTransform().getOrigin().y(), late + 0.2 * i, 2e-3) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Masses, StackOnALattice, testing::Values(0.1, 1.0, 4.0));

}  // namespace
}  // namespace limber::bullet::test
