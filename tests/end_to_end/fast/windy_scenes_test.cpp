#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "demos/scenes/simulation.h"

namespace limber::demos::test {
namespace {

using std::numbers::pi;

RunResult run_of(const Scene& scene, double seconds) {
  RunOptions options;
  options.seconds = seconds;
  return run(scene, options);
}

// Times at which the centre of the only object passes z = 0, s.
std::vector<double> crossings(const RunResult& result) {
  std::vector<double> times;
  for (std::size_t i = 1; i < result.samples.size(); ++i) {
    const double before = result.samples[i - 1].objects[0].centre_of_mass.z();
    const double now = result.samples[i].objects[0].centre_of_mass.z();
    if ((before < 0.0) == (now < 0.0)) continue;
    const double share = before / (before - now);
    times.push_back(result.samples[i - 1].time_s +
                    share * (result.samples[i].time_s - result.samples[i - 1].time_s));
  }
  return times;
}

// Without wind: a physical pendulum about the bar, T = 2 pi sqrt(I / (m g d)), of small swings.
TEST(Swing, HasThePeriodOfAPendulum) {
  Scene scene = build_scene("swing", {{"wind", 0.0}, {"push", 0.3}});
  scene.air.reset();
  const PhysicalModel& model = scene.objects[0];
  constexpr double kBar = 2.2;  // m
  double moment = 0.0, inertia = 0.0;
  for (PointId p : ids_of(model.points)) {
    const Vec3 r = model.geometry.points[p] - Vec3(0.0, kBar, 0.0);
    moment -= model.points[p].mass * r.y();
    inertia += model.points[p].mass * (r.y() * r.y() + r.z() * r.z());
  }
  const double period = 2.0 * pi * std::sqrt(inertia / (moment * 9.81));
  const std::vector<double> times = crossings(run_of(scene, 4.5));
  ASSERT_GE(times.size(), 4u);
  // The first starts at z = 0 itself. Ropes stretch: 1 % of their length, half of that in time.
  EXPECT_NEAR(times[3] - times[1], period, 0.02 * period);
}

TEST(Swing, HangsTogetherInItsWind) {
  const RunResult result = run_of(build_scene("swing"), 2.0);
  EXPECT_EQ(result.broken_edges, 0u);
  EXPECT_EQ(result.summaries[0].fragments, 1u);
  EXPECT_EQ(result.to_rigid, 0u);  // pins hold it
}

TEST(Swing, IsMadeOfThreePartsOfDifferentStiffnessAndWeight) {
  const PhysicalModel model = build_scene("swing").objects[0];
  const auto& parts = model.geometry.subobjects;
  ASSERT_EQ(parts.size(), 5u);  // seat, rope, glue, rope, glue
  const auto mass = [&](const Subobject& part) {
    double sum = 0.0;
    for (std::int32_t p = part.points.begin; p < part.points.end; ++p)
      sum += model.points[PointId(std::size_t(p))].mass;
    return sum;
  };
  EXPECT_NEAR(mass(parts[0]), 450.0 * 0.5 * 0.05 * 0.2, 1e-9);  // a board of spruce
  EXPECT_NEAR(mass(parts[1]), 1480.0 * 1.13097e-4 * 1.68, 1e-4);  // 12 mm of hemp
  EXPECT_NEAR(mass(parts[1]), mass(parts[3]), 1e-12);
  const auto stiffness = [&](const Subobject& part) {
    return model.edges[EdgeId(std::size_t(part.edges.begin))].stiffness;
  };
  EXPECT_GT(stiffness(parts[0]), 2.0 * stiffness(parts[1]));
}

TEST(LeafMagic, HasThreeHundredLeavesAndMore) {
  EXPECT_GE(build_scene("leaf_magic").objects.size(), 300u);
}

double mean_height(const TickSample& sample) {
  double sum = 0.0;
  for (const auto& object : sample.objects) sum += object.centre_of_mass.y();
  return sum / static_cast<double>(sample.objects.size());
}

TEST(LeafMagic, LiftsLeavesThatStillAirLetsFall) {
  const ParameterValues few = {{"leaves", 40.0}};
  const Scene windy = build_scene("leaf_magic", few);
  Scene still = windy;
  still.air->wind.primitives.clear();
  const RunResult lifted = run_of(windy, 3.0), fallen = run_of(still, 3.0);
  EXPECT_GT(mean_height(lifted.samples.back()), 0.5);
  EXPECT_LT(mean_height(fallen.samples.back()), 0.05);
  for (const auto& leaf : lifted.samples.back().objects) {
    EXPECT_GT(leaf.centre_of_mass.y(), 0.0);
    EXPECT_LT(leaf.centre_of_mass.norm(), 8.0);
  }
}

TEST(LeafMagic, RepeatsItselfBitForBit) {
  const Scene scene = build_scene("leaf_magic", {{"leaves", 30.0}});
  EXPECT_EQ(run_of(scene, 1.0).state_hash, run_of(scene, 1.0).state_hash);
}

}  // namespace
}  // namespace limber::demos::test
