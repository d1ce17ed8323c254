#include "core/modeller/cell_stiffness.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "core/modeller/box_lattice.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

using test::block_geometry;

constexpr double kModulus = 2e6;  // Pa

std::vector<Vec3> edge_vectors(const GeometricModel& g) {
  std::vector<Vec3> vectors;
  for (const Edge& e : g.edges) vectors.push_back(g.points[e.b] - g.points[e.a]);
  return vectors;
}

// The edges of a prism over an equilateral triangle, both diagonals on each square.
std::vector<Vec3> prism(double side, double height) {
  const std::array<Vec3, 3> base = {Vec3(0, 0, 0), Vec3(side, 0, 0),
                                    Vec3(side / 2, side * std::sqrt(3.0) / 2, 0)};
  const Vec3 up(0, 0, height);
  std::vector<Vec3> edges;
  for (int i = 0; i < 3; ++i) {
    const Vec3 along = base[(i + 1) % 3] - base[i];
    for (const Vec3& e : {along, along, up, Vec3(along + up), Vec3(along - up)}) edges.push_back(e);
  }
  return edges;
}

double prism_volume(double side, double height) {
  return side * side * std::sqrt(3.0) / 4 * height;
}

// A cell's edges hold 1/4, 1/2 and 1 of the lattice's k1, k2, k3.
TEST(IsotropicCellStiffness, OfACubeFulfilsTheConditionOfIsotropy) {
  const GeometricModel g = block_geometry({.spacing = 0.1});
  const std::vector<Vec3> edges = edge_vectors(g);
  const std::vector<double> k = isotropic_cell_stiffness(edges, 1e-3, kModulus);
  std::array<double, 4> lattice{};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const int kind = static_cast<int>(std::lround(edges[e].squaredNorm() / 0.01));
    const double share = kind == 1 ? 4.0 : kind == 2 ? 2.0 : 1.0;
    const double before = std::exchange(lattice[kind], share * k[e]);
    EXPECT_TRUE(before == 0.0 || std::abs(before - lattice[kind]) < 1e-9 * before);
  }
  const auto [unused, k1, k2, k3] = lattice;
  EXPECT_NEAR(k1, k2 + 8.0 * k3 / 3.0, 1e-9 * k1);
  EXPECT_NEAR((k2 + 4.0 * k3 / 3.0) / 0.1, 0.4 * kModulus, 1e-9 * kModulus);
  EXPECT_LT(anisotropy(edges, k, 1e-3, kModulus), 1e-9);
}

TEST(IsotropicCellStiffness, OfAGoodPrismIsNearlyIsotropic) {
  const std::vector<Vec3> edges = prism(0.0085, 0.006);
  const double volume = prism_volume(0.0085, 0.006);
  const std::vector<double> k = isotropic_cell_stiffness(edges, volume, kModulus);
  EXPECT_LT(anisotropy(edges, k, volume, kModulus), 0.1);
  for (double each : k) EXPECT_GE(each, 0.0);
}

// Trace of the tensor over E: 3 * 1.2 + 6 * 0.4 = 6.
TEST(IsotropicCellStiffness, GivesEveryShapeTheExactBulkModulus) {
  for (double height : {0.1, 0.5, 1.0, 3.0}) {
    const std::vector<Vec3> edges = prism(1.0, height);
    const double volume = prism_volume(1.0, height);
    const std::vector<double> k = isotropic_cell_stiffness(edges, volume, kModulus);
    double trace = 0.0;
    for (std::size_t e = 0; e < k.size(); ++e) trace += k[e] * edges[e].squaredNorm() / volume;
    EXPECT_NEAR(trace, 6.0 * kModulus, 1e-9 * kModulus);
  }
}

TEST(Anisotropy, OfUnequalSpringsIsSeen) {
  const std::vector<Vec3> edges = edge_vectors(block_geometry({}));
  std::vector<double> k = isotropic_cell_stiffness(edges, 1.0, kModulus);
  k[0] += 0.12 * kModulus;  // an edge along an axis: C_1111 grows by a tenth
  EXPECT_NEAR(anisotropy(edges, k, 1.0, kModulus), 0.1, 1e-9);
}

// The edges of a box of one cell, by default all 28.
std::vector<Vec3> box_edges(const Vec3& sides, CellEdges edges = {}) {
  return edge_vectors(box_lattice({1, 1, 1}, sides, Vec3::Zero(), "cell", edges));
}

double anisotropy_of_box(const Vec3& sides, CellEdges edges = {}) {
  const std::vector<Vec3> vectors = box_edges(sides, edges);
  const std::vector<double> k = isotropic_cell_stiffness(vectors, sides.prod(), kModulus);
  return anisotropy(vectors, k, sides.prod(), kModulus);
}

// The closed form of kLongestIsotropicBox against the fit, which knows nothing of it. The fit stops
// where a round of it no longer pays: below the limit it comes to a few hundredths, above it leaves
// what no springs can mend.
TEST(CellStiffness, LongBoxesLoseIsotropyWhereTheClosedFormSays) {
  EXPECT_LT(anisotropy_of_box({1.0, 1.0, 1.0}), 1e-9);
  EXPECT_LT(anisotropy_of_box({1.5, 1.0, 1.0}), 0.06);
  EXPECT_GT(anisotropy_of_box({2.2, 1.0, 1.0}), 0.10);
  EXPECT_GT(anisotropy_of_box({3.0, 1.0, 1.0}), anisotropy_of_box({2.2, 1.0, 1.0}));
}

// Beyond a = sqrt(3) c no non-negative spring constants give C_1111 = 3 C_1122 = 3 C_1133 exactly:
// least misfit over the one free number K by brute force.
double least_long_spring(double a, double b, double c) {  // k a^2 / (E V) of the edges along a
  double best = -1e9;
  for (int i = 0; i <= 1000; ++i) {
    const double fourK = 0.4 * i / 1000.0 / (b * b * c * c);
    const auto square = [&](double p, double q) { return 0.4 / (p * p * q * q) - fourK; };
    if (square(a, b) < 0 || square(a, c) < 0 || square(b, c) < 0) continue;
    const auto along = [&](double p, double q, double r) {
      return 1.2 - std::pow(p, 4) * (square(p, q) + square(p, r) + fourK);
    };
    best = std::max(best, std::min({along(a, b, c), along(b, c, a), along(c, a, b)}));
  }
  return best;
}

TEST(CellStiffness, TheLongestIsotropicBoxIsRootThreeTimesItsShortestSide) {
  const double limit = kLongestIsotropicBox;
  for (double b : {1.0, 1.2, 1.6}) {
    EXPECT_GE(least_long_spring(0.999 * limit, b, 1.0), 0.0) << b;
    EXPECT_LT(least_long_spring(1.001 * limit, b, 1.0), 0.0) << b;
  }
}

TEST(CellFitter, GivesCongruentCellsTheSpringsOfEach) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-1e-15, 1e-15);
  const std::vector<Vec3> edges = box_edges({0.1, 0.12, 0.09});
  CellFitter fitter;
  for (int cell = 0; cell < 20; ++cell) {
    std::vector<Vec3> same = edges;
    for (Vec3& e : same) e += Vec3(jitter(random), jitter(random), jitter(random));
    const double volume = 0.1 * 0.12 * 0.09;
    const std::vector<double> own = isotropic_cell_stiffness(same, volume, kModulus);
    const CellFit& fit = fitter.fit(same);
    for (std::size_t e = 0; e < same.size(); ++e) {
      EXPECT_NEAR(fit.weights[e] * fit.stiffness_per_weight(volume, kModulus), own[e],
                  1e-11 * own[e]);
    }
  }
}

TEST(CellFitter, TellsShapesApartThatDifferByMoreThanRounding) {
  CellFitter fitter;
  for (double side : {0.1, 0.1 * (1 + 1e-6), 0.2, 0.4}) {  // 0.2 and 0.4: the same but for the size
    const std::vector<Vec3> edges = box_edges({side, 0.1, 0.1});
    const double volume = side * 0.01;
    const std::vector<double> own = isotropic_cell_stiffness(edges, volume, kModulus);
    const CellFit& fit = fitter.fit(edges);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      EXPECT_NEAR(fit.weights[e] * fit.stiffness_per_weight(volume, kModulus), own[e],
                  1e-12 * own[e]);
    }
  }
}

TEST(Elongation, OfATurnedBoxIsLongestOverShortestSide) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c)
    corners.push_back(turn * Vec3(0.3 * (c & 1), 0.1 * (c >> 1 & 1), 0.2 * (c >> 2 & 1)) +
                      Vec3(5, 6, 7));
  EXPECT_NEAR(elongation(corners), 3.0, 1e-9);
}

TEST(Elongation, OfAFlatCellIsInfinite) {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_TRUE(std::isinf(elongation(square)));
}

}  // namespace
}  // namespace limber
