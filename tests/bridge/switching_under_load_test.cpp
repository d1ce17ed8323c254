#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// A piece that bears a load and turns flexible and rigid again and again.

namespace limber::bullet::test {
namespace {

constexpr double kWeight = 2.0;  // kg
constexpr int kSwitches = 1000;

// A block of 8 kg on the ground under a weight. As a lattice its contacts bear the two at a depth
// of 5 to 8 mm; as a body it lies on the surface.
struct LoadedBlock {
  World world;
  CoSimulation simulation{*world};
  btRigidBody* weight;

  LoadedBlock() {
    world.add_ground();
    simulation.add(make_block({.modulus = 1e6, .damping_ratio = 0.1, .internal_damping = 50.0},
                              {0.0, 0.15, 0.0}));
    weight = &world.add_box(Vec3::Constant(0.1), kWeight, {0.0, 0.4, 0.0});
    world.run(1.0, kTick);
  }
  bool flexible() const { return simulation.pieces().at(0).flexible; }
  double low() const { return lowest_point(simulation.model(0)); }  // m
  double height_of_weight() const { return weight->getWorldTransform().getOrigin().y(); }

  // J, at rest.
  double energy() const {
    return sums_of(simulation.model(0)).energy(kGravity) + sums_of(*weight).energy(kGravity);
  }

  // Two opposite blows at one place move nothing and make it flexible; until it is rigid again, for
  // two seconds at the most, and a little longer. Returns m, the lowest it came to.
  double switch_once() {
    const Vec3 at = simulation.pieces().at(0).motion.centre;
    for (double blow : {6.0, -6.0}) simulation.apply_impulse(0, blow * Vec3::UnitX(), at);
    double lowest = 0.0;
    const auto step = [&] {
      world.step(kTick);
      lowest = std::min(lowest, low());
    };
    step();
    for (int tick = 0; tick < 120 && flexible(); ++tick) step();
    for (int tick = 0; tick < 9; ++tick) step();
    for (int tick = 0; tick < 120 && flexible(); ++tick) step();  // something shook it
    return lowest;
  }
};

// Contacts take up where they left off. Before they did, the block sank by 7 mm with each switch,
// Bullet lifted it again, and after some 250 it never calmed any more.
TEST(SwitchingUnderLoad, AThousandTimesSinksRisesAndDriftsNoFarther) {
  LoadedBlock block;
  for (int i = 0; i < 3; ++i)
    block.switch_once();  // its contacts' depth is what it falls by at first
  const double energy = block.energy();
  const Vec3 start = block.simulation.pieces().at(0).motion.centre;
  std::vector<double> lowest;  // m
  for (int i = 0; i < kSwitches; ++i) {
    lowest.push_back(block.switch_once());
    ASSERT_FALSE(block.flexible()) << i;
    // Above that of both lifted by half a millimetre.
    EXPECT_LT(block.energy() - energy, (8.0 + kWeight) * kGravity * 0.0005) << i;
  }
  ASSERT_FALSE(block.simulation.failure());
  EXPECT_GE(block.simulation.counters().to_flexible, std::size_t{kSwitches});
  std::sort(lowest.begin(), lowest.end());
  EXPECT_GT(lowest[kSwitches / 2], -0.001);
  EXPECT_GT(lowest.front(), -0.005);
  EXPECT_NEAR(block.low(), 0.0, 0.002);
  EXPECT_NEAR(block.height_of_weight(), 0.4, 0.003);
  // A random walk along the ground, 0.6 mm a switch at the most.
  const Vec3 drift = block.simulation.pieces().at(0).motion.centre - start;
  EXPECT_LT(drift.norm(), 0.0006 * std::sqrt(double{kSwitches}));
}

// The load goes while the block is rigid. What its contacts remember of it throws it nowhere.
TEST(SwitchingUnderLoad, WithoutTheLoadItDoesNotJump) {
  LoadedBlock block;
  block.switch_once();
  ASSERT_FALSE(block.flexible());
  btTransform pose = block.weight->getWorldTransform();
  pose.setOrigin(btVector3(5, btScalar(0.1), 0));
  block.weight->setCenterOfMassTransform(pose);
  const Vec3 at = block.simulation.pieces().at(0).motion.centre;
  for (double blow : {6.0, -6.0}) block.simulation.apply_impulse(0, blow * Vec3::UnitX(), at);
  double fastest = 0.0, highest = 0.0;
  for (int tick = 0; tick < 60; ++tick) {
    block.world.step(kTick);
    fastest = std::max(fastest, sums_of(block.simulation.model(0)).velocity().norm());
    highest = std::max(highest, block.low());
  }
  ASSERT_FALSE(block.simulation.failure());
  EXPECT_LT(fastest, 0.1 + kGravity * kTick);  // contacts let out at 0.1 m/s; a tick of fall
  EXPECT_LT(highest, 0.002);
  EXPECT_NEAR(block.low(), 0.0, 0.002);
}

}  // namespace
}  // namespace limber::bullet::test
