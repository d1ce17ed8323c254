#include "core/analysis/vibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/analysis/equilibrium.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

using std::numbers::pi;
using test::uneven_block;

// Of a chain of n free points between two fixed ones, j = 1 .. n.
double fixed_chain_frequency(double stiffness, double mass, int j, int n) {
  return 2.0 * std::sqrt(stiffness / mass) * std::sin(j * pi / (2.0 * (n + 1)));
}

PhysicalModel fixed_chain(const test::ChainShape& shape) {
  PhysicalModel model = test::chain(shape);
  model.points[PointId(0)].pinned = true;
  model.points[PointId(shape.points - 1)].pinned = true;
  return model;
}

TEST(VibrationModes, TwoPointSpring) {
  PhysicalModel model = test::chain({.points = 2, .stiffness = 300.0});
  model.points[PointId(1)].mass = 2.0;
  const VibrationModes modes = vibration_modes(model);
  EXPECT_EQ(zero_mode_count(modes), 5);
  EXPECT_NEAR(modes.omega_squared[5], 300.0 * (1.0 + 0.5), 1e-11);
  EXPECT_NEAR(modes.shapes(0, 5) / modes.shapes(3, 5), -2.0, 1e-13);
}

TEST(VibrationModes, StretchedChainVibratesAlongAndAcross) {
  // At 1.25 times its rest length: tension 20 N, 20 / 1.25 = 16 N/m across.
  PhysicalModel model = fixed_chain({.points = 6, .stiffness = 80.0, .mass = 0.3, .spacing = 1.25});
  for (EdgeAttributes& e : model.edges) e.rest_length = 1.0;
  std::vector<double> expected;
  for (int j = 1; j <= 4; ++j) {
    expected.push_back(fixed_chain_frequency(80.0, 0.3, j, 4));
    for (int polarisation : {0, 1}) {
      (void)polarisation;
      expected.push_back(fixed_chain_frequency(16.0, 0.3, j, 4));
    }
  }
  std::sort(expected.begin(), expected.end());
  const VibrationModes modes = vibration_modes(model);
  ASSERT_EQ(modes.omega_squared.size(), 12);
  for (int i = 0; i < 12; ++i) {
    EXPECT_NEAR(std::sqrt(modes.omega_squared[i]), expected[i], 1e-12 * expected[i]);
  }
}

TEST(VibrationModes, HangingChainOfTwoPoints) {
  // A double pendulum of equal masses and lengths L: omega^2 = (2 +- sqrt 2) g / L across.
  PhysicalModel model = test::chain({.points = 3, .stiffness = 1e9, .along = -Vec3::UnitZ()});
  model.points[PointId(0)].pinned = true;
  ASSERT_TRUE(settle(model, {0.0, 0.0, -9.81}).converged);
  const VibrationModes modes = vibration_modes(model);
  EXPECT_NEAR(modes.omega_squared[0], (2.0 - std::sqrt(2.0)) * 9.81, 1e-6);
  EXPECT_NEAR(modes.omega_squared[3], (2.0 + std::sqrt(2.0)) * 9.81, 1e-6);
}

TEST(VibrationModes, AreOrthonormalInTheMasses) {
  const PhysicalModel model = uneven_block({2, 1, 1});
  const VibrationModes modes = vibration_modes(model);
  Eigen::VectorXd mass(36);
  for (PointId p : modes.free_points) {
    mass.segment<3>(3 * p.index()).setConstant(model.points[p].mass);
  }
  EXPECT_TRUE((modes.shapes.transpose() * mass.asDiagonal() * modes.shapes).isIdentity(1e-12));
}

TEST(VibrationModes, CountRigidMotionsAndMechanisms) {
  EXPECT_EQ(zero_mode_count(vibration_modes(uneven_block({2, 2, 1}))), 6);
  // One cell of axial edges and body diagonals alone: 24 components, 16 edges, one of them
  // redundant.
  const PhysicalModel floppy = test::block({.edges = {.body_diagonals = true}});
  EXPECT_EQ(zero_mode_count(vibration_modes(floppy)), 9);
}

TEST(VibrationModes, ASqueezedChainIsUnstable) {
  PhysicalModel model = fixed_chain({.points = 5, .spacing = 0.9});
  for (EdgeAttributes& e : model.edges) e.rest_length = 1.0;
  EXPECT_LT(vibration_modes(model).omega_squared[0], 0.0);
  const std::vector<double> lowest = lowest_frequencies(model, 7);
  EXPECT_EQ(lowest[5], 0.0);  // three points, two directions across
  EXPECT_NEAR(lowest[6], fixed_chain_frequency(100.0, 1.0, 1, 3), 1e-10);
}

TEST(LowestFrequencies, AreThoseOfTheWholeSpectrum) {
  // The regular block has equal frequencies, the free ones six of nothing.
  for (const PhysicalModel& model :
       {uneven_block({4, 2, 1}), test::block({.cells = {3, 3, 3}}), test::block({})}) {
    const VibrationModes modes = vibration_modes(model);
    const std::vector<double> lowest = lowest_frequencies(model, 15);
    ASSERT_EQ(lowest.size(), 15u);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(lowest[i], 0.0, 1e-5);
    for (int i = 6; i < 15; ++i) {
      EXPECT_NEAR(lowest[i] / std::sqrt(modes.omega_squared[i]), 1.0, 1e-10);
    }
  }
}

TEST(LowestFrequencies, OfALongChain) {
  PhysicalModel model = fixed_chain({.points = 502, .spacing = 1.01});
  for (EdgeAttributes& e : model.edges) e.rest_length = 1.0;
  const double across = 100.0 * 0.01 / 1.01;
  const std::vector<double> lowest = lowest_frequencies(model, 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(lowest[i] / fixed_chain_frequency(across, 1.0, 1 + i / 2, 500), 1.0, 1e-9);
  }
}

TEST(LowestFrequencies, AreFewerInASmallModel) {
  EXPECT_EQ(lowest_frequencies(test::chain({.points = 2}), 10).size(), 6u);
  EXPECT_EQ(lowest_frequencies(test::chain({.points = 1}), 10), std::vector<double>(3, 0.0));
  EXPECT_TRUE(lowest_frequencies(fixed_chain({.points = 2}), 10).empty());
}

TEST(ExactHighestFrequency, OfChains) {
  for (int n : {2, 3, 10, 400}) {
    const PhysicalModel free = test::chain({.points = n});
    const double exact = 2.0 * 10.0 * std::sin((n - 1) * pi / (2.0 * n));
    EXPECT_NEAR(exact_highest_frequency(free) / exact, 1.0, 1e-10);
    const PhysicalModel fixed = fixed_chain({.points = n + 2});
    const double held = fixed_chain_frequency(100.0, 1.0, n, n);
    EXPECT_NEAR(exact_highest_frequency(fixed) / held, 1.0, 1e-10);
  }
  EXPECT_EQ(exact_highest_frequency(test::chain({.points = 1})), 0.0);
}

// Nine motions of twelve are free: zero is an eigenvalue many times over, which stopped the solver
// of the tridiagonal matrix short in one of some thousand of these.
TEST(ExactHighestFrequency, OfBentChainsIsThatOfTheWholeSpectrum) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> stiffness(1.0, 10.0);
  for (int n = 0; n < 20000; ++n) {
    PhysicalModel model = test::chain({.points = 4, .mass = 0.02});
    for (Vec3& x : model.geometry.points) x += test::random_vector(random, 0.5);
    for (EdgeAttributes& e : model.edges) e.stiffness = stiffness(random);
    const VibrationModes modes = vibration_modes(model);
    const double exact = std::sqrt(modes.omega_squared[modes.omega_squared.size() - 1]);
    ASSERT_NEAR(exact_highest_frequency(model) / exact, 1.0, 1e-10) << n;
  }
}

TEST(ExactHighestFrequency, OfBlocksIsThatOfTheWholeSpectrum) {
  PhysicalModel strained = uneven_block({3, 2, 2});
  for (Vec3& p : strained.geometry.points) p.x() *= 1.2;
  for (const PhysicalModel& model :
       {uneven_block({4, 3, 2}), test::block({.cells = {4, 4, 4}}), strained}) {
    const double exact = std::sqrt(vibration_modes(model).omega_squared.maxCoeff());
    EXPECT_NEAR(exact_highest_frequency(model) / exact, 1.0, 1e-10);
  }
}

TEST(FrequencyBounds, OfOneCellHaveTheirClosedForms) {
  PhysicalModel model = test::block({.edges = {.both_diagonals = true}});
  for (EdgeAttributes& e : model.edges) e.stiffness = 1.0;
  const FrequencyBounds bounds = frequency_bounds(model);
  EXPECT_NEAR(bounds.points, std::sqrt(12.0), 1e-14);
  EXPECT_NEAR(bounds.point_blocks, 3.0, 1e-14);
  EXPECT_NEAR(bounds.edges, std::sqrt(4.0 + 2.0 * std::sqrt(2.0)), 1e-14);
}

TEST(FrequencyBounds, LieAboveTheHighestFrequency) {
  for (const std::array<int, 3>& cells : {std::array{1, 1, 1}, {4, 1, 1}, {3, 3, 2}}) {
    PhysicalModel model = uneven_block(cells);
    model.edges[EdgeId(2)].broken = true;
    const double exact = exact_highest_frequency(model);
    const FrequencyBounds bounds = frequency_bounds(model);
    EXPECT_GE(bounds.edges, exact);
    EXPECT_GE(bounds.point_blocks, exact);
    EXPECT_GE(bounds.points, bounds.point_blocks);
  }
}

}  // namespace
}  // namespace limber
