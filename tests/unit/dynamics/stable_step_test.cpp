#include "core/dynamics/stable_step.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "core/analysis/vibration.h"
#include "core/model/errors.h"
#include "tests/support/blocks.h"
#include "tests/support/dense.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

using test::uneven_block;

// Within the 0.5 % that the proof adds.
constexpr double kSlack = 1.0051;

PhysicalModel chain(int points, double stiffness, double mass) {
  return test::chain({.points = points, .stiffness = stiffness, .mass = mass, .spacing = 0.1});
}

// By dense eigenvalues of the whole matrix.
double exact_frequency(const PhysicalModel& model) {
  const Eigen::MatrixXd K = test::dense_matrix(model, &EdgeAttributes::stiffness);
  const Eigen::MatrixXd M = test::dense_masses(model).asDiagonal();
  return std::sqrt(
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M).eigenvalues().maxCoeff());
}

void expect_tight_bound(const PhysicalModel& model, double exact) {
  const FrequencyBound bound = highest_frequency(model);
  EXPECT_TRUE(bound.verified);
  EXPECT_GE(bound.omega_max, exact);
  EXPECT_LE(bound.omega_max, kSlack * exact);
}

TEST(HighestFrequency, OfADumbbellIsTheRootOfTwoKOverM) {
  expect_tight_bound(chain(2, 300.0, 0.5), std::sqrt(2.0 * 300.0 / 0.5));
}

TEST(HighestFrequency, OfAFreeChainIsTheClosedForm) {
  for (int n : {3, 5, 10, 50}) {
    const double exact = 2.0 * std::sqrt(300.0 / 0.5) * std::cos(std::numbers::pi / (2 * n));
    expect_tight_bound(chain(n, 300.0, 0.5), exact);
  }
}

TEST(HighestFrequency, OfALatticeIsThatOfDenseEigenvalues) {
  const PhysicalModel even = test::block({.cells = {3, 3, 3}});
  expect_tight_bound(even, exact_frequency(even));
  const PhysicalModel uneven = uneven_block({3, 2, 4});
  expect_tight_bound(uneven, exact_frequency(uneven));
}

TEST(HighestFrequency, LeavesBrokenEdgesOut) {
  PhysicalModel model = chain(5, 300.0, 0.5);
  model.edges[EdgeId(std::size_t{1})].broken = true;  // the longer rest has three points
  expect_tight_bound(model, 2.0 * std::sqrt(300.0 / 0.5) * std::cos(std::numbers::pi / 6));
}

TEST(HighestFrequency, OfBigModelsIsBoundedByTheirElements) {
  for (const PhysicalModel& model :
       {chain(5, 300.0, 0.5), test::block({.cells = {3, 3, 3}}), uneven_block({2, 2, 2})}) {
    const FrequencyBound bound = highest_frequency(model, 1);
    EXPECT_FALSE(bound.verified);
    EXPECT_GE(bound.omega_max, exact_frequency(model));
    EXPECT_LE(bound.omega_max, 1.7 * exact_frequency(model));
  }
}

// A chain fills nothing: its factor has the 6 entries of every point and the 9 of every edge, so
// that what is known beforehand decides no earlier than the analysis does.
TEST(HighestFrequency, IsProvedUpToTheEntriesOfTheFactor) {
  const PhysicalModel model = chain(40, 300.0, 0.5);
  EXPECT_TRUE(highest_frequency(model, 40 * 6 + 39 * 9).verified);
  EXPECT_FALSE(highest_frequency(model, 40 * 6 + 39 * 9 - 1).verified);
}

TEST(HighestFrequency, OfLoosePointsIsZero) {
  const FrequencyBound bound = highest_frequency(chain(1, 0.0, 1.0));
  EXPECT_EQ(bound.omega_max, 0.0);
  EXPECT_TRUE(bound.verified);
  EXPECT_TRUE(std::isinf(stable_step(bound.omega_max, 0.2)));
}

// Semi-implicit Euler with damping from the old velocity.
double amplitude_after(int steps, double omega, double zeta, double dt) {
  double x = 1.0, v = 0.0;
  for (int i = 0; i < steps; ++i) {
    v += dt * (-omega * omega * x - 2.0 * zeta * omega * v);
    x += dt * v;
  }
  return std::hypot(x, v / omega);
}

TEST(StableStep, IsWhereADampedOscillatorStartsToGrow) {
  const double omega = 250.0;
  for (double zeta : {0.0, 0.05, 0.2, 1.0}) {
    const double dt = stable_step(omega, zeta);
    EXPECT_LT(amplitude_after(20000, omega, zeta, 0.999 * dt), 100.0) << zeta;
    EXPECT_FALSE(amplitude_after(20000, omega, zeta, 1.001 * dt) < 1e6) << zeta;  // or not a number
  }
}

// Eigenvalues crowd at the end of a long rope's spectrum: to find the largest to ten digits would
// take thousands of steps.
TEST(HighestFrequency, OfALongRopeIsFound) {
  const FrequencyBound bound = highest_frequency(chain(5000, 300.0, 0.5));
  EXPECT_TRUE(bound.verified);
  const double exact = 2.0 * std::sqrt(300.0 / 0.5);  // less (pi / 10000)^2 / 2
  EXPECT_GT(bound.omega_max, exact * (1.0 - 1e-6));
  EXPECT_LT(bound.omega_max, exact * 1.04);
}

// Whatever the spring's direction turns out to be: the bound is that of the dumbbell at rest.
TEST(HighestFrequency, OfCoincidentPointsIsThatOfTheirSpring) {
  PhysicalModel model = chain(2, 300.0, 0.5);
  model.geometry.points[PointId(std::size_t{1})] = model.geometry.points[PointId(std::size_t{0})];
  expect_tight_bound(model, std::sqrt(2.0 * 300.0 / 0.5));
}

// The tangent stiffness of a compressed lattice is smaller than that at rest, to which it returns.
TEST(HighestFrequency, OfACompressedLatticeIsNoLowerThanAtRest) {
  const PhysicalModel rest = test::block({.cells = {2, 2, 2}});
  for (double scale : {0.8, 0.3, -0.5, 0.0}) {
    PhysicalModel model = rest;
    for (Vec3& x : model.geometry.points) x *= scale;
    for (std::size_t most_entries : {std::size_t{3500000}, std::size_t{1}}) {
      EXPECT_GE(highest_frequency(model, most_entries).omega_max, exact_frequency(rest)) << scale;
    }
  }
}

// By definition: the tangent stiffness of a lattice stretched to twice its size, dense.
TEST(HighestFrequency, OfALatticeUnderTensionIsNotExceeded) {
  PhysicalModel model = test::block({.cells = {2, 2, 2}});
  for (Vec3& x : model.geometry.points) x *= 2.0;
  const double exact = exact_highest_frequency(model);
  for (std::size_t most_entries : {std::size_t{3500000}, std::size_t{1}}) {
    EXPECT_GE(highest_frequency(model, most_entries).omega_max, exact);
  }
}

TEST(StableStep, KeepsItsDigitsWhereDampingIsAll) {
  // 2 / omega / (2 zeta) to first order
  EXPECT_DOUBLE_EQ(stable_step(250.0, 1e9), 1.0 / (250.0 * 1e9));
  EXPECT_GT(stable_step(1.0, 1e300), 0.0);
  EXPECT_LT(stable_step(1.0, 1e300), 1e-299);
}

TEST(HighestFrequency, BeyondAllNumbersIsRefused) {
  EXPECT_THROW(highest_frequency(chain(3, 1e308, 0.5)), InputError);
  EXPECT_THROW(highest_frequency(chain(3, 300.0, 1e-320)), InputError);
}

}  // namespace
}  // namespace limber
