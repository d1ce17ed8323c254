#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

// A brittle stick and a block fall on boxes: touches, breaks, hand-overs and debris.
std::vector<std::uint64_t> hashes() {
  World world;
  world.add_ground();
  for (int i = 0; i < 3; ++i) world.add_box({0.2, 0.1, 0.2}, 1.0, {0.0, 0.1 + 0.2 * i, 0.0});
  CoSimulation simulation(*world);
  simulation.add(make_block(
      {.cells = {10, 1, 1}, .spacing = 0.05, .mass = 1.0, .modulus = 5e7, .strain_at_break = 0.004},
      {0.05, 1.2, 0.0}, {0.0, -3.0, 0.0}, {0.0, 1.0, 2.0}));
  simulation.add(make_block({.cells = {2, 2, 2}, .mass = 2.0, .modulus = 1e6}, {0.1, 2.0, 0.05}));
  std::vector<std::uint64_t> result;
  for (int tick = 0; tick < 60; ++tick) {
    world.step(kTick);
    result.push_back(simulation.state_hash());
  }
  EXPECT_FALSE(simulation.failure());
  EXPECT_GT(simulation.counters().broken_edges, 0u);
  EXPECT_GT(simulation.counters().to_rigid, 0u);
  return result;
}

TEST(Determinism, TheSameSceneTwiceHasTheSameBits) {
  const std::vector<std::uint64_t> first = hashes();
  EXPECT_EQ(first, hashes());
  for (std::size_t i = 1; i < first.size(); ++i) EXPECT_NE(first[i], first[i - 1]);
}

}  // namespace
}  // namespace limber::bullet::test
