#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <sstream>
#include <string>

#include "demos/scripting/script_scene.h"

// What is seen in the scenes that ship: pins fall, glass breaks into shards, a bridge holds.
// Numbers leave room for other builds and precisions, whose breaks differ; what they measured is
// beside them. (The teapot, the swing, leaves and the jelly have tests of their own.)

namespace limber::demos::test {
namespace {

struct Outcome {
  RunResult result;
  std::string printed;

  double shards() const {  // kg
    return std::accumulate(result.piece_masses.begin(), result.piece_masses.end(), 0.0);
  }
  double dust_share() const { return 1.0 - shards() / result.total_mass; }
  std::size_t broken_things() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        result.summaries, [](const BodySummary& body) { return body.broken_edges > 0; }));
  }
};

Outcome outcome_of(const std::string& name, const ParameterValues& changes = {}) {
  std::ostringstream printed;
  ScriptSettings settings;
  settings.printed = &printed;
  const Scene scene = build_scene(name, changes, settings);
  Outcome outcome{run(scene, {}), printed.str()};
  EXPECT_FALSE(outcome.result.failure) << outcome.result.failure->text();
  return outcome;
}

// 7 of them in the build that this was written with; whole, as pins should be.
TEST(ShippedScenes, BowlingPinsFall) {
  const Outcome outcome = outcome_of("bowling");
  ASSERT_EQ(outcome.result.summaries.size(), 10u);
  const auto down = std::ranges::count_if(outcome.result.summaries, [](const BodySummary& pin) {
    return pin.centre_of_mass.y() < 0.12;
  });
  EXPECT_GE(down, 5);
  EXPECT_EQ(outcome.result.broken_edges, 0u);
  EXPECT_GT(outcome.result.to_flexible, 5u);  // pins are hit as lattices
}

// A ball that comes too far from the middle meets none.
TEST(ShippedScenes, BowlingMayMiss) {
  const Outcome outcome = outcome_of("bowling", {{"aside", -0.5}, {"speed", 7.0}});
  EXPECT_EQ(outcome.printed.substr(0, outcome.printed.find(' ')), "1") << outcome.printed;
}

// 3 of 6, in shards: 1 % of the mass is dust.
TEST(ShippedScenes, ChinaBreaksIntoShards) {
  const Outcome outcome = outcome_of("china_shop");
  EXPECT_GE(outcome.broken_things(), 2u);
  EXPECT_LT(outcome.broken_things(), 6u);  // what the ball does not reach stays whole
  EXPECT_GE(outcome.result.fragments, 15u);
  EXPECT_LT(outcome.dust_share(), 0.05);
}

// 29 pieces, the largest 0.23 of 3.6 kg, 4 % dust.
TEST(ShippedScenes, HailBreaksGlassIntoShards) {
  const Outcome outcome = outcome_of("hail_on_glass");
  ASSERT_TRUE(outcome.result.first_break_s);
  EXPECT_LT(*outcome.result.first_break_s, 1.0);
  EXPECT_GE(outcome.result.fragments, 10u);
  EXPECT_LT(outcome.result.piece_masses.front(), 0.5 * outcome.result.total_mass);
  EXPECT_LT(outcome.dust_share(), 0.12);
}

// All three, in shards: 3 % dust.
TEST(ShippedScenes, SlingshotHitsItsBottles) {
  const Outcome outcome = outcome_of("slingshot");
  EXPECT_EQ(outcome.printed, "3 shots, 3 of 3 bottles broke\n");
  EXPECT_GE(outcome.result.fragments, 15u);
  EXPECT_LT(outcome.dust_share(), 0.12);
}

TEST(ShippedScenes, NobodyShootsWithoutAPlayer) {
  const Outcome outcome = outcome_of("slingshot", {{"player", 0.0}});
  EXPECT_EQ(outcome.printed, "0 shots, 0 of 3 bottles broke\n");
  EXPECT_EQ(outcome.result.broken_edges, 0u);
}

// Down by 0.22 m, up again to 0.77 of the metre that it fell: no higher than it came from.
TEST(ShippedScenes, TrampolineThrowsBack) {
  const Outcome outcome = outcome_of("trampoline");
  double pressed = 0.0, up = 0.0;
  ASSERT_EQ(
      std::sscanf(outcome.printed.c_str(), "pressed in by %lf m, up again to %lf m", &pressed, &up),
      2)
      << outcome.printed;
  EXPECT_GT(pressed, 0.1);
  EXPECT_LT(pressed, 0.5);
  EXPECT_GT(up, 0.5);
  EXPECT_LT(up, 1.0);
  EXPECT_EQ(outcome.result.broken_edges, 0u);
}

// 17 pieces; the largest, 129 of 768 kg, stays where it stood.
TEST(ShippedScenes, WreckingBallBreaksTheWall) {
  const Outcome outcome = outcome_of("wrecking_ball");
  ASSERT_TRUE(outcome.result.first_break_s);
  // A quarter of the swing: 2 pi sqrt(1.6 m / g) / 4 = 0.63 s, more for 1.1 rad.
  EXPECT_NEAR(*outcome.result.first_break_s, 0.7, 0.15);
  EXPECT_GE(outcome.result.fragments, 8u);
  EXPECT_LT(outcome.result.piece_masses.front(), 0.6 * outcome.result.total_mass);
  EXPECT_LT(outcome.dust_share(), 0.5);
}

TEST(ShippedScenes, RopeBridgeHolds) {
  const Outcome outcome = outcome_of("rope_bridge");
  EXPECT_EQ(outcome.printed, "the crate is on the bridge\n");
  EXPECT_EQ(outcome.result.broken_edges, 0u);
  EXPECT_EQ(outcome.result.fragments, 1u);
  // Its own 12 kg and the crate's 20 kg bend it down from y = 1 m.
  EXPECT_LT(outcome.result.summaries[0].centre_of_mass.y(), 0.97);
  EXPECT_GT(outcome.result.summaries[0].centre_of_mass.y(), 0.6);
}

// Twenty times the load tears it.
TEST(ShippedScenes, RopeBridgeBreaksUnderTooMuch) {
  const Outcome outcome = outcome_of("rope_bridge", {{"mass", 400.0}, {"height", 1.0}});
  EXPECT_EQ(outcome.printed, "the crate is down\n");
  EXPECT_GT(outcome.result.fragments, 1u);
}

TEST(ShippedScenes, AllDominoesFall) {
  const Outcome outcome = outcome_of("dominoes");
  EXPECT_EQ(outcome.printed, "16 of 16 fell\n");
}

TEST(ShippedScenes, DominoesStandUntilTheyArePushed) {
  const Outcome outcome = outcome_of("dominoes", {{"push", 0.0}, {"biscuits", 4.0}});
  EXPECT_EQ(outcome.printed, "0 of 4 fell\n");
}

}  // namespace
}  // namespace limber::demos::test
