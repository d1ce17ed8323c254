#include "core/modeller/bending_springs.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/analysis/equilibrium.h"
#include "core/analysis/periodic_lattice.h"
#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/modeller/sheet.h"
#include "core/modeller/thin_material.h"

namespace limber {
namespace {

using std::numbers::pi;

constexpr double kRadius = 0.05;     // m, of the arc in the plane x, y
constexpr double kThickness = 2e-6;  // m
constexpr double kModulus = 1e9;     // Pa
constexpr double kDensity = 1000.0;  // kg/m^3

Material foil() { return {.density = kDensity, .youngs_modulus = kModulus}; }

// n rows of cells along a quarter of a circle from (R, 0) to (0, R), n / 4 equilateral or square
// ones in a row, which runs along the direction that is not bent.
struct Strip {
  int n;
  SheetCells cells;

  double row() const { return kRadius * pi / 2 / n; }  // m
  double width() const {
    return n / 4 * row() * (cells == SheetCells::kTriangles ? 2.0 / std::sqrt(3.0) : 1.0);
  }
};

PhysicalModel bare(const Strip& strip) {
  const ParametricSurface quarter = [&](double u, double v) -> Vec3 {
    return {kRadius * std::cos(pi / 2 * v), kRadius * std::sin(pi / 2 * v), strip.width() * u};
  };
  return with_sheet_material(sheet(quarter, {strip.n / 4, strip.n, strip.cells, false}, "strip"),
                             "strip", foil(), {.thickness = kThickness});
}

BendingSprings springs() {
  BendingSprings s;
  s.youngs_modulus = kModulus;
  s.thickness = kThickness;
  return s;
}

// How far the free end of a curved cantilever of weight q (N/m) and bending stiffness B sinks; it
// is clamped at the angle `begin` and free at pi/2. Castigliano: integral of M m / B along the arc,
// M the moment of the weight beyond, m that of a unit load at the end.
double sinking(double begin, double q, double B) {
  constexpr int kSteps = 400;
  const double step = (pi / 2 - begin) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double at = begin + (i + 0.5) * step;
    // Weight of d(phi) at phi > at has the arm R (cos(at) - cos(phi)).
    const double M = q * kRadius * kRadius * ((pi / 2 - at) * std::cos(at) - (1.0 - std::sin(at)));
    const double m = kRadius * std::cos(at);
    sum += M * m / B * kRadius * step;
  }
  return sum;
}

void hold_first_two_rows(PhysicalModel& m, const Strip& strip) {
  for (PointId p : ids_of(m.points)) {
    const Vec3& x = m.geometry.points[p];
    m.points[p].pinned = kRadius * std::atan2(x.y(), x.x()) < 1.001 * strip.row();
  }
}

double mean_sinking_of_the_end(const PhysicalModel& m) {
  const auto moved = linear_sag(m, {0.0, -9.81, 0.0});
  double sum = 0.0;
  int count = 0;
  for (PointId p : ids_of(m.points)) {
    if (m.geometry.points[p].x() > 1e-6) continue;
    sum -= moved[p].y();
    ++count;
  }
  return sum / count;
}

// The strip's bending stiffness over E I, by its sinking. The two rows that are held clamp it in
// the middle between them.
double relative_stiffness(const Strip& strip) {
  PhysicalModel m = bare(strip);
  EXPECT_GT(add_bending_springs(m, springs()), 0);
  EXPECT_TRUE(validate(m).empty());
  hold_first_two_rows(m, strip);
  const double EI = kModulus * strip.width() * std::pow(kThickness, 3) / 12.0;
  const double q = kDensity * strip.width() * kThickness * 9.81;
  return sinking(0.25 * pi / strip.n, q, EI) / mean_sinking_of_the_end(m);
}

// E I / (1 - nu^2) with nu = 1/3: a thin strip's own curvature keeps it straight across, as the
// middle of a wide plate.
TEST(BendingSprings, ACurvedStripHasThePlatesBendingStiffness) {
  for (int n : {16, 32, 64}) {
    EXPECT_NEAR(relative_stiffness({n, SheetCells::kSquares}), 1.125, 0.01) << n;
    EXPECT_NEAR(relative_stiffness({n, SheetCells::kTriangles}), 1.125, 0.01) << n;
  }
}

// Without springs it only has what keeps rows of points apart: nothing.
TEST(BendingSprings, WithoutThemTheStripIsLimp) {
  const Strip strip{16, SheetCells::kSquares};
  PhysicalModel m = bare(strip);
  hold_first_two_rows(m, strip);
  EXPECT_THROW(linear_sag(m, {0.0, -9.81, 0.0}), InputError);
}

// Flat, all springs are at their limit, and the stretch stiffness grows by just that share.
TEST(BendingSprings, AFlatSheetGetsTheLimit) {
  const ParametricSurface plane = [](double u, double v) -> Vec3 { return {u, v, 0.0}; };
  PhysicalModel m = with_sheet_material(sheet(plane, {10, 10, SheetCells::kSquares, false}, "flat"),
                                        "flat", foil(), {.thickness = kThickness});
  const PointId middle(std::size_t{5 * 11 + 5});
  const double volume = 0.01 * kThickness;
  const ElasticityMatrix before = elasticity(lattice_around(m, middle, volume));
  BendingSprings s = springs();
  s.most_added_stretch = 0.07;
  // 9 of 11 lines of 9 pairs both ways, also along the sides; diagonals of 9 x 9 points both ways.
  EXPECT_EQ(add_bending_springs(m, s), 2 * 11 * 9 + 2 * 9 * 9);
  EXPECT_TRUE(validate(m).empty());
  const ElasticityMatrix after = elasticity(lattice_around(m, middle, volume));
  EXPECT_LT((after - 1.07 * before).norm(), 1e-6 * before.norm());
}

// Flat cells twice as long as wide: isotropy leaves nothing for the lines along them. A spring of
// nothing under no rise is no spring.
TEST(BendingSprings, LeaveOutLinesThatCarryNothing) {
  const ParametricSurface plane = [](double u, double v) -> Vec3 { return {2.0 * u, v, 0.0}; };
  PhysicalModel m = with_sheet_material(sheet(plane, {6, 6, SheetCells::kSquares, false}, "flat"),
                                        "flat", foil(), {.thickness = kThickness});
  const std::size_t before = m.edges.size();
  const int added = add_bending_springs(m, springs());
  EXPECT_EQ(m.edges.size(), before + static_cast<std::size_t>(added));
  EXPECT_TRUE(validate(m).empty());
  for (std::size_t e = before; e < m.edges.size(); ++e)
    EXPECT_GT(m.edges[EdgeId(e)].stiffness, 0.0) << e;
  // As many as squares would get, but for the five along each of the inner five rows.
  EXPECT_EQ(added, 120 - 5 * 5);
}

// Four triangles around a point, two of them folded back onto the others: their areas cancel.
TEST(BendingSprings, LeaveOutFolds) {
  GeometricModelBuilder builder;
  builder.begin_subobject("fold");
  const PointId middle = builder.add_point({0, 0, 0});
  const std::array<PointId, 4> rim = {builder.add_point({1, 0, 0}), builder.add_point({0, 1, 0}),
                                      builder.add_point({-1, 0, 0}), builder.add_point({0, 1, 0})};
  for (std::size_t i = 0; i < 4; ++i) {
    const PointId a = rim[i], b = rim[(i + 1) % 4];
    const std::array<std::array<PointId, 2>, 3> edges = {{{middle, a}, {a, b}, {b, middle}}};
    const std::array<std::array<PointId, 3>, 1> face = {{{middle, a, b}}};
    builder.add_cell(edges, face);
  }
  PhysicalModel m =
      with_sheet_material(builder.finish(), "fold", foil(), {.thickness = kThickness});
  EXPECT_EQ(add_bending_springs(m, springs()), 0);
}

TEST(BendingSprings, RefuseWhatIsSenseless) {
  PhysicalModel m = bare({8, SheetCells::kSquares});
  const auto add = [&](auto change) {
    BendingSprings s = springs();
    change(s);
    return add_bending_springs(m, s);
  };
  EXPECT_THROW(add([](auto& s) { s.thickness = 0.0; }), InputError);
  EXPECT_THROW(add([](auto& s) { s.youngs_modulus = NAN; }), InputError);
  EXPECT_THROW(add([](auto& s) { s.most_added_stretch = -0.1; }), InputError);
  EXPECT_THROW(add([](auto& s) { s.strain_at_break = 0.0; }), InputError);
  m.geometry.subobjects.push_back(m.geometry.subobjects.front());
  EXPECT_THROW(add([](auto&) {}), InputError);
}

}  // namespace
}  // namespace limber
