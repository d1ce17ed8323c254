#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bridge/measure.h"
#include "tests/bridge/world.h"
#include "tests/support/bursting_brick.h"

namespace limber::bullet::test {
namespace {

constexpr int kAlong = 4;
constexpr std::size_t kFragments = kAlong * kAlong * kAlong;

struct Burst {
  World world;
  CoSimulation simulation{*world};
  Burst() {
    world.add_ground();
    simulation.add(bursting_brick(kAlong, {0.0, 0.5, 0.0}));
  }
  std::size_t flexible() const {
    const std::vector<PieceView> pieces = simulation.pieces();
    return static_cast<std::size_t>(
        std::count_if(pieces.begin(), pieces.end(), [](const auto& p) { return p.flexible; }));
  }
};

TEST(Burst, ComesApartWithinOneTickIntoFragmentsOfWholeCells) {
  Burst burst;
  burst.world.step(kTick);
  ASSERT_FALSE(burst.simulation.failure());
  ASSERT_EQ(burst.simulation.splits().size(), 1u);
  EXPECT_EQ(burst.simulation.splits()[0].parts.size(), kFragments);
  EXPECT_EQ(burst.simulation.splits()[0].particles, 0u);
  for (const PieceView& piece : burst.simulation.pieces()) EXPECT_EQ(piece.points.size(), 8u);
}

TEST(Burst, KeepsMassAndMomentum) {
  const PhysicalModel before = bursting_brick(kAlong, {0.0, 0.5, 0.0});
  const double mass = sums_of(before).mass;
  Burst burst;
  constexpr int kTicks = 3;  // in the air
  for (int n = 0; n < kTicks; ++n) burst.world.step(kTick);
  double found = 0.0, speeds = 0.0;
  Vec3 momentum = Vec3::Zero();
  for (const PieceView& piece : burst.simulation.pieces()) {
    found += piece.motion.mass;
    momentum += piece.motion.momentum();
    speeds += piece.motion.momentum().norm();
  }
  EXPECT_NEAR(found, mass, 1e-9 * mass);
  EXPECT_LT((momentum - Vec3(0.0, -mass * kGravity * kTicks * kTick, 0.0)).norm(),
            by_precision(1e-6, 1e-7) * speeds);
}

TEST(Burst, IsRigidAfterThreeTicks) {
  Burst burst;
  for (int n = 0; n < 3; ++n) burst.world.step(kTick);
  EXPECT_EQ(burst.flexible(), 0u);
  // No index of pieces names what is gone.
  EXPECT_EQ(burst.simulation.pieces().size(), kFragments);
  EXPECT_EQ(burst.world->getNumCollisionObjects(), static_cast<int>(kFragments) + 1);
}

TEST(Burst, LiesStillAsRigidFragmentsAtLast) {
  Burst burst;
  burst.world.run(5.0, kTick);
  ASSERT_FALSE(burst.simulation.failure());
  EXPECT_EQ(burst.flexible(), 0u);
  EXPECT_EQ(burst.simulation.pieces().size(), kFragments);
  for (const PieceView& piece : burst.simulation.pieces()) {
    EXPECT_LT(piece.motion.velocity.norm(), 0.05);
    EXPECT_GT(piece.motion.centre.y(), 0.0);
  }
  // What lies there costs no substeps.
  const std::uint64_t before = burst.simulation.counters().spring_updates;
  for (int n = 0; n < 10; ++n) burst.world.step(kTick);
  EXPECT_EQ(burst.simulation.counters().spring_updates, before);
}

}  // namespace
}  // namespace limber::bullet::test
