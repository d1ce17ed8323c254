#include <gtest/gtest.h>

#include "demos/scenes/simulation.h"

namespace limber::demos::test {
namespace {

RunResult run_switching(double seconds) {
  RunOptions options;
  options.seconds = seconds;
  return run(build_scene("tipsy_teapot"), options);
}

// Nothing touches the teapot before 0.36 s: the table's top lies 0.6 m below its lowest point.
TEST(TipsyTeapotFlight, IsRigidAndCostsNoSpringUpdate) {
  const RunResult flight = run_switching(0.3);
  ASSERT_EQ(flight.summaries.size(), 1u);
  EXPECT_EQ(flight.summaries[0].representation, "rigid");
  EXPECT_EQ(flight.spring_updates, 0u);
  EXPECT_EQ(flight.flexible_share, 0.0);
  EXPECT_FALSE(flight.first_break_s);
  ASSERT_EQ(flight.switches.size(), 1u);
  EXPECT_EQ(flight.switches[0].cause, "start");
  EXPECT_FALSE(flight.switches[0].to_flexible);
}

// Long enough to hit the table's edge and break.
TEST(TipsyTeapotFlight, RepeatsItselfBitForBit) {
  const RunResult once = run_switching(0.6);
  const RunResult again = run_switching(0.6);
  EXPECT_GT(once.broken_edges, 0u);
  EXPECT_EQ(once.state_hash, again.state_hash);
  EXPECT_EQ(once.broken_edges, again.broken_edges);
  EXPECT_EQ(once.first_break_s, again.first_break_s);
  EXPECT_EQ(once.piece_masses, again.piece_masses);
  EXPECT_EQ(once.spring_updates, again.spring_updates);
}

}  // namespace
}  // namespace limber::demos::test
