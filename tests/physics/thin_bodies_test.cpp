#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/analysis/equilibrium.h"
#include "core/analysis/vibration.h"
#include "core/modeller/rope.h"
#include "core/modeller/sheet.h"
#include "core/modeller/thin_material.h"

// Ropes and sheets from materials against the closed forms of strings, bars and membranes.
namespace limber {
namespace {

using std::numbers::pi;

constexpr double kG = 9.81;          // m/s^2
constexpr double kLength = 2.0;      // m
constexpr double kSection = 3e-5;    // m^2
constexpr double kDensity = 1200.0;  // kg/m^3
constexpr double kModulus = 4e6;     // Pa
const Vec3 kGravity(0.0, -kG, 0.0);

Material material(double modulus = kModulus) {
  Material m;
  m.density = kDensity;
  m.youngs_modulus = modulus;
  return m;
}

void pin(PhysicalModel& m, std::size_t point) { m.points[PointId(point)].pinned = true; }

PhysicalModel hanging_rope(int segments, double modulus = kModulus) {
  const Curve down = polyline({{0, 0, 0}, {0, -kLength, 0}});
  PhysicalModel m = with_rope_material(rope(points_along(down, segments), "rope"), "rope",
                                       material(modulus), kSection);
  pin(m, 0);
  return m;
}

// rho g L^2 / (2 E), with any number of segments: half of each one's weight hangs below it.
TEST(Rope, StretchesUnderItsOwnWeight) {
  for (int n : {1, 3, 20}) {
    PhysicalModel m = hanging_rope(n);
    ASSERT_TRUE(settle(m, kGravity).converged);
    const double extension = -m.geometry.points.raw().back().y() - kLength;
    EXPECT_NEAR(extension, kDensity * kG * kLength * kLength / (2.0 * kModulus), 1e-11);
  }
}

// (pi / 2 L) sqrt(E / rho), fixed and free; n segments have (2 c / h) sin(pi h / (4 L)).
TEST(Rope, LowestLongitudinalFrequencyConverges) {
  const double c = std::sqrt(kModulus / kDensity);
  const double exact = pi / (2.0 * kLength) * c;
  const auto omega = [](int n) {
    const Eigen::VectorXd squared = vibration_modes(hanging_rope(n)).omega_squared;
    return std::sqrt(squared[2 * n]);  // after the 2 n motions across, which nothing resists
  };
  for (int n : {4, 8, 16}) {
    EXPECT_NEAR(omega(n), 2.0 * c * n / kLength * std::sin(pi / (4.0 * n)), 1e-8 * exact);
  }
  EXPECT_NEAR((exact - omega(8)) / (exact - omega(16)), 4.0, 0.05);
}

// Daniel Bernoulli's hanging chain: (j / 2) sqrt(g / L), j = 2.404826 the first zero of J0.
TEST(Rope, PendulumSwingsAsTheHangingChain) {
  const double exact = 2.404825557695773 / 2.0 * std::sqrt(kG / kLength);
  const auto error = [&](int n) {
    PhysicalModel m = hanging_rope(n, 1e3 * kModulus);
    EXPECT_TRUE(settle(m, kGravity).converged);
    const double omega = lowest_frequencies(m, 1).at(0);
    return omega / exact - 1.0;
  };
  const double coarse = error(10), fine = error(20), finest = error(40);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
  EXPECT_NEAR(fine / finest, 4.0, 0.4);
  EXPECT_LT(std::abs(finest), 5e-4);
}

// a of the catenary a cosh(x / a) of this length over this span: L = 2 a sinh(D / 2 a).
double catenary_parameter(double length, double span) {
  double low = 0.01 * span, high = 100.0 * span;
  for (int i = 0; i < 200; ++i) {
    const double a = 0.5 * (low + high);
    (2.0 * a * std::sinh(span / (2.0 * a)) > length ? low : high) = a;
  }
  return low;
}

TEST(Rope, SagsAsTheCatenary) {
  const double span = 1.5;
  const double a = catenary_parameter(kLength, span);
  const double exact = a * (std::cosh(span / (2.0 * a)) - 1.0);
  const double drop = std::sqrt(kLength * kLength - span * span) / 2.0;
  const auto error = [&](int n) {
    const Curve bent = polyline({{0, 0, 0}, {span / 2, -drop, 0}, {span, 0, 0}});
    PhysicalModel m = with_rope_material(rope(points_along(bent, n), "rope"), "rope",
                                         material(1e4 * kModulus), kSection);
    pin(m, 0);
    pin(m, std::size_t(n));
    EXPECT_TRUE(settle(m, kGravity).converged);
    return -m.geometry.points[PointId(std::size_t(n) / 2)].y() - exact;
  };
  const double coarse = error(8), fine = error(16), finest = error(32);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
  EXPECT_NEAR(fine / finest, 4.0, 0.4);
  EXPECT_LT(std::abs(finest), 1e-3 * exact);
}

constexpr double kThickness = 1e-3;  // m

const double kHeight = 1.5 * std::sqrt(3.0);  // m, whole rows of equilateral triangles

// 1 m along x, kHeight along y, in the plane z = 0, cells of 1 m / n.
PhysicalModel long_sheet(int n, SheetCells cells) {
  const ParametricSurface plane = [](double u, double v) -> Vec3 { return {u, kHeight * v, 0.0}; };
  return with_sheet_material(sheet(plane, grid_for(plane, 1.0 / n, cells), "sheet"), "sheet",
                             material(), {.thickness = kThickness});
}

struct Stretched {
  double stiffness = 0.0;      // N/m, force / width / strain in the middle third
  double poisson_ratio = 0.0;  // there
};

// The ends are drawn apart and together as plane stress says, and held: a clamp of constant width
// would wrinkle the sheet, as it does real ones. What lies between has free sides.
Stretched stretched(PhysicalModel m) {
  constexpr double kStrain = 1e-7;
  const IdVector<PointId, Vec3> before = m.geometry.points;
  for (PointId p : ids_of(before)) {
    m.points[p].pinned = before[p].y() < 1e-9 || before[p].y() > kHeight - 1e-9;
    m.geometry.points[p].y() += kStrain * (before[p].y() - 0.5 * kHeight);
    if (m.points[p].pinned) m.geometry.points[p].x() -= kStrain / 3.0 * (before[p].x() - 0.5);
  }
  EXPECT_TRUE(settle(m, Vec3::Zero()).converged);
  double force = 0.0;
  const IdVector<PointId, Vec3> support = support_forces(m, Vec3::Zero());
  for (PointId p : ids_of(before)) {
    if (before[p].y() > 0.5 * kHeight) force += support[p].y();
  }
  // Least squares of the displacements over the points of the middle third.
  double syy = 0.0, suy = 0.0, sxx = 0.0, sux = 0.0;
  for (PointId p : ids_of(before)) {
    const Vec3 x = before[p] - Vec3(0.5, 0.5 * kHeight, 0.0), u = m.geometry.points[p] - before[p];
    if (std::abs(x.y()) > kHeight / 6.0) continue;
    syy += x.y() * x.y();
    suy += x.y() * u.y();
    sxx += x.x() * x.x();
    sux += x.x() * u.x();
  }
  const double strain = suy / syy;
  return {force / strain, -(sux / sxx) / strain};
}

// Squares are isotropic each by itself; the sheet is so up to its sides.
TEST(Sheet, UniaxialStretchOfSquaresHasTheModulusAndAThirdAsPoissonRatio) {
  for (int n : {4, 8}) {
    const Stretched s = stretched(long_sheet(n, SheetCells::kSquares));
    EXPECT_NEAR(s.stiffness, kModulus * kThickness, 1e-6 * kModulus * kThickness) << n;
    EXPECT_NEAR(s.poisson_ratio, 1.0 / 3.0, 1e-6) << n;
  }
}

// The half triangles at the ends of rows are too stiff: a seam of half a cell on either side.
TEST(Sheet, UniaxialStretchOfTrianglesConverges) {
  const auto error = [](int n) {
    const Stretched s = stretched(long_sheet(n, SheetCells::kTriangles));
    return Stretched{s.stiffness / (kModulus * kThickness) - 1.0, s.poisson_ratio - 1.0 / 3.0};
  };
  const Stretched coarse = error(8), fine = error(16);
  EXPECT_NEAR(coarse.stiffness / fine.stiffness, 2.0, 0.2);
  EXPECT_LT(std::abs(fine.stiffness), 0.01);
  EXPECT_LT(std::abs(fine.poisson_ratio), 0.01);
}

// A square of 1 m under the tension T, N/m, held at its border.
PhysicalModel square_drum(int n, SheetCells cells, double prestrain) {
  const ParametricSurface plane = [](double u, double v) -> Vec3 { return {u, v, 0.0}; };
  PhysicalModel m = with_sheet_material(sheet(plane, grid_for(plane, 1.0 / n, cells), "drum"),
                                        "drum", material(), {.thickness = kThickness});
  for (EdgeAttributes& e : m.edges) e.rest_length /= 1.0 + prestrain;
  for (PointId p : ids_of(m.points)) {
    const Vec3& x = m.geometry.points[p];
    m.points[p].pinned = std::min({x.x(), x.y(), 1.0 - x.x(), 1.0 - x.y()}) < 1e-9;
  }
  return m;
}

// omega = (pi / a) sqrt(2 T / (rho t)), with T = E t strain / (1 - nu), nu = 1/3: the strain is
// that of the springs about their rest lengths, which the forces k (l - l0) are linear in.
TEST(Sheet, DrumsLowestFrequencyConverges) {
  const double prestrain = 0.02;
  const double tension = 1.5 * kModulus * kThickness * prestrain / (1.0 + prestrain);
  const double exact = pi * std::sqrt(2.0 * tension / (kDensity * kThickness));
  for (SheetCells cells : {SheetCells::kTriangles, SheetCells::kSquares}) {
    const auto error = [&](int n) {
      return 1.0 - lowest_frequencies(square_drum(n, cells, prestrain), 1).at(0) / exact;
    };
    const double coarse = error(8), fine = error(16);
    EXPECT_NEAR(coarse / fine, 4.0, 0.4);
    EXPECT_LT(std::abs(fine), 5e-3);
  }
}

}  // namespace
}  // namespace limber
