#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/reference/build.h"
#include "tests/reference/cubic.h"
#include "tests/reference/hermite.h"
#include "tests/reference/mode_families.h"
#include "tests/reference/oscillation.h"
#include "tests/reference/run.h"

// What the runner reads numbers off with, against signals and motions that are known.

namespace limber::reference {
namespace {

std::vector<double> sampled(double interval, const std::function<double(double)>& signal) {
  std::vector<double> samples;
  for (int i = 0; i < 60; ++i) samples.push_back(signal(i * interval));
  return samples;
}

TEST(FitOscillation, FindsFrequencyAndDamping) {
  const auto samples =
      sampled(0.05, [](double t) { return std::exp(-0.8 * t) * std::cos(7.0 * t + 0.3); });
  const Oscillation found = fit_oscillation(samples, 0.05);
  EXPECT_NEAR(found.omega_d, 7.0, 1e-10);
  EXPECT_NEAR(found.omega0, std::hypot(7.0, 0.8), 1e-10);
  EXPECT_NEAR(found.zeta, 0.8 / std::hypot(7.0, 0.8), 1e-11);
}

TEST(FitOscillation, CallsAnUndampedOneUndamped) {
  const auto samples = sampled(0.05, [](double t) { return 0.1 * std::sin(5.0 * t + 1.0); });
  EXPECT_EQ(fit_oscillation(samples, 0.05).zeta, 0.0);
}

// Overdamped: rates 1 and 4 are omega0 = 2, zeta = 1.25. Critical: a double rate of 3.
TEST(FitOscillation, FindsWhatDoesNotOscillate) {
  const auto over = sampled(0.05, [](double t) { return 2.0 * std::exp(-t) - std::exp(-4.0 * t); });
  EXPECT_NEAR(fit_oscillation(over, 0.05).omega0, 2.0, 1e-9);
  EXPECT_NEAR(fit_oscillation(over, 0.05).zeta, 1.25, 1e-9);
  EXPECT_EQ(fit_oscillation(over, 0.05).omega_d, 0.0);
  const auto critical = sampled(0.05, [](double t) { return (1.0 + t) * std::exp(-3.0 * t); });
  EXPECT_NEAR(fit_oscillation(critical, 0.05).omega0, 3.0, 1e-9);
  EXPECT_NEAR(fit_oscillation(critical, 0.05).zeta, 1.0, 1e-9);
}

TEST(FitRecurrence, FindsGrowthOfAlternatingSigns) {
  const std::vector<double> samples = {1.0, -1.5, 2.25, -3.375, 5.0625, -7.59375};
  const std::vector<double> mixed = {2.0, -1.0, 2.5, -3.25, 5.125, -7.5625};  // + 0.5^n
  EXPECT_NEAR(fit_recurrence(samples).largest_factor(), 1.5, 1e-12);
  EXPECT_NEAR(fit_recurrence(mixed).largest_factor(), 1.5, 1e-12);
  EXPECT_THROW(fit_recurrence(std::vector<double>{1.0, 2.0, 3.0}), std::runtime_error);
}

// A parabola and a cubic are met exactly: 3 - (t - 2)^2, and t^3 - t with extrema at +-1/sqrt(3).
TEST(Extremum, OfPolynomialsIsExact) {
  const auto parabola = extremum_between({1.0, 2.0, 2.0}, {4.0, -1.0, -4.0});
  ASSERT_TRUE(parabola);
  EXPECT_NEAR(parabola->time, 2.0, 1e-14);
  EXPECT_NEAR(parabola->value, 3.0, 1e-14);
  const auto cubic = extremum_between({0.0, 0.0, -1.0}, {1.0, 0.0, 2.0});
  ASSERT_TRUE(cubic);
  EXPECT_NEAR(cubic->time, 1.0 / std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(cubic->value, -2.0 / std::sqrt(27.0), 1e-14);
}

TEST(Extremum, IsNotThereWhereTheRateKeepsItsSign) {
  EXPECT_FALSE(extremum_between({0.0, 0.0, 1.0}, {1.0, 2.0, 3.0}));
}

TEST(PeakRecorder, FindsPeaksBetweenReadings) {
  PeakRecorder recorder;
  for (int i = 0; i <= 70; ++i) {
    const double t = 0.1 * i;
    recorder.read({t, 2.0 * std::sin(t) - 0.5, 2.0 * std::cos(t)});
  }
  EXPECT_NEAR(recorder.highest().value, 1.5, 1e-6);
  EXPECT_NEAR(recorder.lowest().value, -2.5, 1e-6);
  EXPECT_NEAR(recorder.farthest().time, 1.5 * std::numbers::pi, 1e-4);
}

// 2 kg on 50 N/m, released at 0.1 m: 5 rad/s, through the middle at pi / 10 s.
PhysicalModel oscillator() {
  return network({{Vec3::Zero(), 1.0, Vec3::Zero(), true}, {Vec3(1.1, 0.0, 0.0), 2.0}},
                 {{0, 1, 50.0, 1.0}});
}

TEST(Run, StopsAtTheMomentAskedFor) {
  reference::Run run(oscillator());
  const auto inside = [&] { return stretch(run.lattice(), 0) < 0.0; };
  while (!run.step_until(inside, 0.002)) ASSERT_LT(run.time(), 1.0);
  EXPECT_NEAR(run.time(), 0.1 * std::numbers::pi, 1e-8);
  EXPECT_NEAR(stretch(run.lattice(), 0), 0.0, 1e-10);
  EXPECT_NEAR(stretch_rate(run.lattice(), 0), -0.5, 1e-8);
}

TEST(Run, EndsWhereTheSampleIs) {
  reference::Run run(oscillator());
  run.advance_to(0.123456, 0.002);
  EXPECT_EQ(run.time(), 0.123456);
  EXPECT_NEAR(stretch(run.lattice(), 0), 0.1 * std::cos(5.0 * 0.123456), 1e-8);
  EXPECT_NEAR(energy(run.lattice()), 0.25, 1e-8);
}

TEST(Run, KnowsTheForcesAndMovesNothing) {
  reference::Run run(oscillator());
  EXPECT_NEAR(run.forces()[1].x(), -5.0, 1e-12);
  EXPECT_EQ(run.lattice().motion[1].velocity, Vec3::Zero());
  EXPECT_EQ(run.time(), 0.0);
}

TEST(Run, KnowsTheStableStep) {
  EXPECT_NEAR(reference::Run(oscillator()).stable_step(), 2.0 / 5.0, 1e-12);
}

// Three turns backwards, in steps of a tenth of one.
TEST(AngleCounter, CountsBeyondWholeTurns) {
  AngleCounter counter;
  double last = 0.0;
  for (int i = 1; i <= 30; ++i) {
    const double angle = -0.2 * std::numbers::pi * i;
    last = counter.count(std::atan2(std::sin(angle), std::cos(angle)));
  }
  EXPECT_NEAR(last, -6.0 * std::numbers::pi, 1e-12);
}

TEST(Tension, IsThatOfTheSpringAlone) {
  const Lattice lattice = compiled(oscillator());
  EXPECT_NEAR(tension(lattice, 0), 5.0, 1e-12);
  EXPECT_NEAR(elastic_energy(lattice), 0.25, 1e-12);
}

// Point (2, 0, 3) of 3 x 2 x 4 is where it should be, and so says its index.
TEST(CubicLattice, NumbersItsPointsAlongXFirst) {
  const CubicLattice shape = cubic_of({{"points", {3, 2, 4}}, {"a", 0.5}, {"k1", 1.0}});
  const PointId point = point_of(shape, {2, 0, 3});
  EXPECT_EQ(cubic_model(shape).geometry.points[point], Vec3(1.0, 0.0, 1.5));
  EXPECT_EQ(layer_of(shape, point, 0), 2);
  EXPECT_EQ(layer_of(shape, point, 1), 0);
  EXPECT_EQ(layer_of(shape, point, 2), 3);
  EXPECT_EQ(layer_points(shape, 2, 3).size(), 6u);
}

TEST(CubicLattice, TellsItsEdgesApart) {
  EXPECT_EQ(family_of(0.1, 0.1), "axial");
  EXPECT_EQ(family_of(0.1 * std::sqrt(2.0), 0.1), "face");
  EXPECT_EQ(family_of(0.1 * std::sqrt(3.0), 0.1), "body");
}

// Two masses between two walls, drawn out to twice the rest length: along x k/m and 3 k/m; across,
// with the tension k L0 over the length 2 L0, half of that.
TEST(ModeFamilies, AreToldApart) {
  std::vector<MassPoint> points;
  for (int i = 0; i < 4; ++i) {
    points.push_back({Vec3(2.0 * i, 0.0, 0.0), 1.0, Vec3::Zero(), i == 0 || i == 3});
  }
  const ModeFamilies found =
      mode_families(network(points, chain_bonds(4, 8.0, 1.0)), Vec3::UnitX());
  ASSERT_EQ(found.along.size(), 2u);
  ASSERT_EQ(found.across.size(), 2u);
  EXPECT_NEAR(found.along[0], std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(found.along[1], std::sqrt(24.0), 1e-12);
  EXPECT_NEAR(found.across[0], 2.0, 1e-12);
  EXPECT_NEAR(found.across[1], std::sqrt(12.0), 1e-12);
  EXPECT_NEAR(found.lowest_shape_across[0], 1.0, 1e-12);
}

}  // namespace
}  // namespace limber::reference
