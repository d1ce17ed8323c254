#include "demos/cli/comparison.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace limber::demos {
namespace {

Mat3 rotation(double angle_rad, const Vec3& axis) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

// Samples at 0.1 s, 0.2 s, ... of one object at these places.
RunResult run_along_x(const std::vector<double>& places_m) {
  RunResult run;
  run.object_size_m = 0.5;
  run.total_mass = 1.0;
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const double t = 0.1 * static_cast<double>(i + 1);
    run.samples.push_back({t, {{Vec3(places_m[i], 0.0, 0.0), Mat3::Identity()}}});
  }
  return run;
}

RunResult run_with_pieces(std::vector<double> masses) {
  RunResult run;
  run.total_mass = 2.0;
  run.piece_masses = std::move(masses);
  return run;
}

TEST(AngleBetween, IsExactFromNoneToHalfATurn) {
  const Vec3 axis(1.0, -2.0, 0.5);
  const Mat3 start = rotation(0.7, Vec3(0.3, 1.0, 0.2));
  for (double angle : {0.0, 1e-9, 1e-3, 1.0, std::numbers::pi / 2, 3.0, std::numbers::pi - 1e-6}) {
    EXPECT_NEAR(angle_between(start, start * rotation(angle, axis)), angle, 1e-15 + 1e-9 * angle);
  }
  EXPECT_NEAR(angle_between(start, start * rotation(1e-9, axis)), 1e-9, 5e-16);
  EXPECT_NEAR(angle_between(start, start * rotation(std::numbers::pi, axis)), std::numbers::pi,
              1e-12);
}

TEST(SortedL1, PadsTheShorterListWithZeros) {
  // Sorted: 5 3 1 against 4 4: 1 + 1 + 1.
  EXPECT_DOUBLE_EQ(sorted_l1({3.0, 5.0, 1.0}, {4.0, 4.0}), 3.0);
  EXPECT_DOUBLE_EQ(sorted_l1({1.0, 2.0}, {2.0, 1.0}), 0.0);
  EXPECT_DOUBLE_EQ(sorted_l1({}, {1.5}), 1.5);
}

TEST(ErrorsBetween, DividesTheLargestDistanceByTheSize) {
  const Errors e = errors_between(run_along_x({0.0, 0.1, 0.2}), run_along_x({0.0, 0.15, 0.21}));
  EXPECT_DOUBLE_EQ(e.com_rel.value(), 0.05 / 0.5);
  EXPECT_DOUBLE_EQ(e.rotation_rad.value(), 0.0);
}

TEST(ErrorsBetween, LooksNoFurtherThanTheFirstBreakOfEither) {
  const RunResult a = run_along_x({0.0, 0.0, 0.0});
  RunResult b = run_along_x({0.01, 0.02, 0.40});
  EXPECT_DOUBLE_EQ(errors_between(a, b).com_rel.value(), 0.8);
  b.first_break_s = 0.25;
  EXPECT_DOUBLE_EQ(errors_between(a, b).com_rel.value(), 0.04);
  EXPECT_DOUBLE_EQ(errors_between(b, a).com_rel.value(), 0.04);
}

TEST(ErrorsBetween, HasNoPoseErrorWhereTheFirstTickBreaks) {
  RunResult a = run_along_x({0.0, 0.0});
  a.first_break_s = 0.01;
  const Errors e = errors_between(a, a);
  EXPECT_FALSE(e.com_rel.has_value());
  EXPECT_FALSE(e.rotation_rad.has_value());
  EXPECT_TRUE(e.fragment_mass_l1.has_value());
}

TEST(ErrorsBetween, TakesTheWorstOfAllObjects) {
  RunResult a = run_along_x({0.0});
  RunResult b = a;
  a.samples[0].objects.push_back({Vec3::Zero(), Mat3::Identity()});
  b.samples[0].objects.push_back({Vec3(0.0, 0.3, 0.4), rotation(0.25, Vec3::UnitY())});
  EXPECT_DOUBLE_EQ(errors_between(a, b).com_rel.value(), 1.0);
  EXPECT_NEAR(errors_between(a, b).rotation_rad.value(), 0.25, 1e-15);
}

TEST(ErrorsBetween, LeavesOutWhatCannotBeDivided) {
  const Errors e = errors_between(RunResult{}, RunResult{});
  EXPECT_FALSE(e.com_rel.has_value());
  EXPECT_FALSE(e.fragment_mass_l1.has_value());
}

TEST(NoiseOf, IsTheMeanOverAllPairs) {
  const std::vector<RunResult> runs = {run_with_pieces({2.0}), run_with_pieces({1.0, 1.0}),
                                       run_with_pieces({1.5, 0.5})};
  // L1 / mass: (1 + 1) / 2, (0.5 + 0.5) / 2, (0.5 + 0.5) / 2.
  EXPECT_DOUBLE_EQ(noise_of(runs).fragment_mass_l1.value(), (1.0 + 0.5 + 0.5) / 3.0);
  EXPECT_FALSE(noise_of(runs).com_rel.has_value());
}

TEST(ErrorOf, LeavesOutPairsOfTheSameStep) {
  const std::vector<RunResult> flexible = {run_with_pieces({2.0}), run_with_pieces({1.0, 1.0})};
  const std::vector<RunResult> switching = {run_with_pieces({2.0}), run_with_pieces({1.5, 0.5})};
  // (0, 1): (0.5 + 0.5) / 2; (1, 0): (1 + 1) / 2; the equal pair (0, 0) would give 0.
  EXPECT_DOUBLE_EQ(error_of(flexible, switching).fragment_mass_l1.value(), 0.75);
}

TEST(ErrorOf, TakesTheOnlyPairThereIs) {
  const std::vector<RunResult> flexible = {run_with_pieces({2.0})};
  const std::vector<RunResult> switching = {run_with_pieces({1.0, 1.0})};
  EXPECT_DOUBLE_EQ(error_of(flexible, switching).fragment_mass_l1.value(), 1.0);
}

TEST(Pieces, CountOnlyThoseOverHalfAPercent) {
  RunResult run = run_with_pieces({1.2, 0.7, 0.0101, 0.01, 0.001});
  run.debris_mass = 0.05;
  EXPECT_EQ(count_pieces(run), 3u);
  EXPECT_DOUBLE_EQ(largest_piece_rel(run, run_with_pieces({1.5, 0.5})).value(), 0.75);
  EXPECT_DOUBLE_EQ(debris_rel(run_with_pieces({2.0}), run).value(), 0.025);
}

TEST(Compare, DividesFlexibleBySwitching) {
  ComparedRuns runs;
  runs.flexible.resize(1);
  runs.switching.resize(1);
  runs.flexible[0].wall_s = 8.0;
  runs.flexible[0].spring_updates = 4000;
  runs.switching[0].wall_s = 2.0;
  runs.switching[0].spring_updates = 500;
  runs.spring_rate = 1000.0;
  const Comparison c = compare(runs);
  EXPECT_DOUBLE_EQ(c.speedup.value(), 4.0);
  EXPECT_DOUBLE_EQ(c.update_ratio.value(), 8.0);
  EXPECT_DOUBLE_EQ(c.baseline_efficiency.value(), 0.5);
  EXPECT_FALSE(c.noise.has_value());
  EXPECT_FALSE(c.median_speedup.has_value());
}

TEST(Compare, SaysNothingAboutWhatWasNotMeasured) {
  ComparedRuns runs;
  runs.flexible.resize(2);
  runs.switching.resize(2);
  const Comparison c = compare(runs);
  EXPECT_FALSE(c.speedup.has_value());
  EXPECT_FALSE(c.update_ratio.has_value());
  EXPECT_FALSE(c.baseline_efficiency.has_value());
  EXPECT_TRUE(c.noise.has_value());
}

TEST(StepScale, OnlyGetsSmaller) {
  EXPECT_DOUBLE_EQ(step_scale(0), 1.0);
  EXPECT_DOUBLE_EQ(step_scale(3), 0.97);
}

TEST(Median, IsTheMiddle) {
  EXPECT_DOUBLE_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_DOUBLE_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
}

}  // namespace
}  // namespace limber::demos
