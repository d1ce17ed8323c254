#include "core/modeller/cubic_lattice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/operators/boundary_operator.h"
#include "tests/support/measure.h"

namespace limber {
namespace {

using ::testing::HasSubstr;

constexpr CubicSprings kAll = {.axial = 1000.0, .face_diagonal = 800.0, .body_diagonal = 200.0};

CubicLattice lattice(std::array<int, 3> points, CubicSprings springs = kAll,
                     CubicSurface surface = CubicSurface::kUniform) {
  return {.points = points, .spacing = 0.1, .springs = springs, .surface = surface};
}

double sum_of_masses(const PhysicalModel& m) {
  double sum = 0.0;
  for (const PointAttributes& p : m.points) sum += p.mass;
  return sum;
}

// Independent counts and energies (group "lattice elasticity", kind affine_energy, of the project's
// reference cases): the energy of all springs after x -> F x.
struct AffineCase {
  CubicLattice lattice;
  Mat3 gradient;
  std::size_t edges;
  double energy;  // J
};

double energy_after(const PhysicalModel& m, const Mat3& gradient) {
  double energy = 0.0;
  for (EdgeId e : ids_of(m.edges)) {
    const auto& [a, b] = m.geometry.edges[e];
    const double length = (gradient * (m.geometry.points[b] - m.geometry.points[a])).norm();
    energy += 0.5 * m.edges[e].stiffness * std::pow(length - m.edges[e].rest_length, 2);
  }
  return energy;
}

Mat3 rows(const Vec3& x, const Vec3& y, const Vec3& z) {
  Mat3 m;
  m << x.transpose(), y.transpose(), z.transpose();
  return m;
}

std::vector<AffineCase> affine_cases() {
  const CubicSprings axial_and_faces{.axial = 1000.0, .face_diagonal = 1000.0};
  const Mat3 mixed = rows({1.2, 0.1, 0.0}, {-0.05, 0.9, 0.02}, {0.0, 0.15, 1.1});
  const Mat3 shear = rows({1.0, 0.3, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
  return {
      {lattice({4, 4, 4}, axial_and_faces), Vec3(1.001, 1.0, 1.0).asDiagonal(), 360,
       0.0006001799325110989},
      {lattice({4, 3, 5}, kAll, CubicSurface::kShared), mixed, 425, 23.974333533420136},
      {{.points = {3, 3, 3}, .spacing = 0.25, .springs = {500.0, 500.0, 500.0}},
       shear,
       158,
       32.36474185421598},
      {lattice({5, 4, 3}, axial_and_faces, CubicSurface::kShared),
       Vec3(1.0001, 0.99997, 0.99998).asDiagonal(), 329, 3.012139798434933e-06},
  };
}

// 1e-12: the small strains lose as much in L - L0.
TEST(CubicLattice, AgreesWithTheReferenceEnergies) {
  for (const AffineCase& c : affine_cases()) {
    const PhysicalModel m = cubic_lattice(c.lattice);
    EXPECT_EQ(m.edges.size(), c.edges);
    EXPECT_NEAR(energy_after(m, c.gradient), c.energy, 1e-12 * std::max(c.energy, 1e-3));
    EXPECT_TRUE(validate(m).empty());
  }
}

// Moments about the centre, kg m^2, from the same reference (kind inertia).
Vec3 moments(const PhysicalModel& m) {
  Vec3 centre = Vec3::Zero(), sum = Vec3::Zero();
  for (PointId p : ids_of(m.points)) centre += m.points[p].mass * m.geometry.points[p];
  centre /= sum_of_masses(m);
  for (PointId p : ids_of(m.points)) {
    const Vec3 r2 = (m.geometry.points[p] - centre).cwiseAbs2();
    sum += m.points[p].mass * Vec3(r2[1] + r2[2], r2[2] + r2[0], r2[0] + r2[1]);
  }
  return sum;
}

TEST(CubicLattice, AgreesWithTheReferenceInertia) {
  CubicLattice wanted = lattice({3, 4, 5});
  wanted.mass = 0.02;
  const PhysicalModel uniform = cubic_lattice(wanted);
  EXPECT_NEAR(sum_of_masses(uniform), 1.2, 1e-14);
  EXPECT_LT((moments(uniform) - Vec3(0.039, 0.032, 0.023)).norm(), 1e-15);
  wanted.surface = CubicSurface::kShared;
  const PhysicalModel shared = cubic_lattice(wanted);
  EXPECT_NEAR(sum_of_masses(shared), 0.48, 1e-14);
  EXPECT_LT((moments(shared) - Vec3(0.0116, 0.0096, 0.0068)).norm(), 1e-15);
}

// What the unit cells add up to, counted on the finished hierarchy: an edge has k1/4, k2/2 or k3
// for each of its cubes, k1/2 or k2 for each of its squares.
TEST(CubicLattice, SharedStiffnessIsASumOverCells) {
  for (std::array<int, 3> points :
       {std::array{4, 3, 5}, std::array{2, 2, 2}, std::array{4, 1, 3}}) {
    const PhysicalModel m = cubic_lattice(lattice(points, kAll, CubicSurface::kShared));
    const bool sheet = points[1] == 1;
    const IndexRows cells_of = edge_cells(m.geometry);
    for (EdgeId e : ids_of(m.edges)) {
      const double cells = static_cast<double>(cells_of[e.index()].size());
      const double steps = std::round(std::pow(m.edges[e].rest_length / 0.1, 2));  // 1, 2 or 3
      const double of_a_cell = steps == 1.0   ? 1000.0 / (sheet ? 2.0 : 4.0)
                               : steps == 2.0 ? 800.0 / (sheet ? 1.0 : 2.0)
                                              : 200.0;
      EXPECT_DOUBLE_EQ(m.edges[e].stiffness, cells * of_a_cell);
    }
  }
}

TEST(CubicLattice, SharedRopeHasHalfMassesAtItsEnds) {
  const PhysicalModel m = cubic_lattice(lattice({1, 4, 1}, kAll, CubicSurface::kShared));
  EXPECT_EQ(m.points[PointId(0)].mass, 0.5);
  EXPECT_EQ(m.points[PointId(1)].mass, 1.0);
  EXPECT_EQ(sum_of_masses(m), 3.0);
  for (const EdgeAttributes& e : m.edges) EXPECT_EQ(e.stiffness, 1000.0);
}

// (n - 1) m and so on; k3 has no place in a sheet, diagonals none in a rope.
TEST(CubicLattice, SheetRopeAndParticleHaveTheCountsOfTheFormulas) {
  const PhysicalModel sheet = cubic_lattice(lattice({4, 3, 1}));
  EXPECT_EQ(sheet.edges.size(), 3u * 3u + 4u * 2u + 2u * 3u * 2u);
  EXPECT_EQ(sheet.cells.size(), 3u * 2u);
  EXPECT_EQ(sheet.faces.size(), 2u * 3u * 2u);
  const PhysicalModel rope = cubic_lattice(lattice({1, 1, 5}));
  EXPECT_EQ(rope.points.size(), 5u);
  EXPECT_EQ(rope.edges.size(), 4u);
  EXPECT_EQ(rope.faces.size() + rope.cells.size(), 0u);
  const PhysicalModel particle = cubic_lattice(lattice({1, 1, 1}));
  EXPECT_EQ(particle.points.size(), 1u);
  EXPECT_EQ(particle.edges.size(), 0u);
  for (const PhysicalModel& m : {sheet, rope, particle}) EXPECT_TRUE(validate(m).empty());
}

TEST(CubicLattice, FacesOfASheetLookAlongItsThinAxis) {
  for (int flat = 0; flat < 3; ++flat) {
    std::array<int, 3> points = {3, 3, 3};
    points[flat] = 1;
    const SurfaceModel surface = boundary(cubic_lattice(lattice(points)));
    ASSERT_EQ(surface.triangles.size(), 8u);
    for (const auto& t : surface.triangles) {
      const Vec3& a = surface.points[t.corners[0]];
      const Vec3 normal =
          (surface.points[t.corners[1]] - a).cross(surface.points[t.corners[2]] - a);
      EXPECT_NEAR(normal[flat], 0.01, 1e-15);
    }
  }
}

TEST(CubicLattice, FacesOfABlockLookOutwards) {
  const SurfaceModel surface = boundary(cubic_lattice(lattice({3, 4, 2})));
  EXPECT_EQ(test::unmatched_sides(surface), 0);
  EXPECT_NEAR(test::enclosed_volume(surface), 0.2 * 0.3 * 0.1, 1e-16);
}

// Every subset of the families: absent when its constant is 0, valid whatever is left.
TEST(CubicLattice, FamiliesWithoutStiffnessAreAbsent) {
  for (std::array<int, 3> points : {std::array{3, 3, 3}, std::array{3, 1, 3}, std::array{3, 1, 1}})
    for (int set = 0; set < 8; ++set) {
      const CubicSprings springs{set & 1 ? 1.0 : 0.0, set & 2 ? 2.0 : 0.0, set & 4 ? 3.0 : 0.0};
      const PhysicalModel m = cubic_lattice(lattice(points, springs));
      EXPECT_TRUE(validate(m).empty()) << validate(m).front().text();
      for (const EdgeAttributes& e : m.edges) EXPECT_GT(e.stiffness, 0.0);
      const bool sheet = points[1] == 1 && points[2] > 1, block = points[1] > 1;
      EXPECT_EQ(m.cells.size(), block && set > 0 ? 8u : sheet && set & 1 ? 4u : 0u);
      EXPECT_EQ(m.points.size(), static_cast<std::size_t>(points[0] * points[1] * points[2]));
    }
}

TEST(CubicLattice, PointsRunAlongXFirst) {
  CubicLattice wanted = lattice({3, 4, 2});
  wanted.origin = Vec3(1.0, 2.0, 3.0);
  const PhysicalModel m = cubic_lattice(wanted);
  EXPECT_TRUE(m.geometry.points[PointId(2)].isApprox(Vec3(1.2, 2.0, 3.0)));
  EXPECT_TRUE(m.geometry.points[PointId(3)].isApprox(Vec3(1.0, 2.1, 3.0)));
  EXPECT_TRUE(m.geometry.points[PointId(12)].isApprox(Vec3(1.0, 2.0, 3.1)));
  EXPECT_EQ(m.name, "lattice");
  EXPECT_EQ(m.geometry.subobjects.size(), 1u);
}

TEST(CubicLattice, DampingIsProportionalToStiffness) {
  CubicLattice wanted = lattice({3, 3, 3}, kAll, CubicSurface::kShared);
  wanted.damping_per_stiffness = 1e-3;
  for (const EdgeAttributes& e : cubic_lattice(wanted).edges)
    EXPECT_DOUBLE_EQ(e.damping, 1e-3 * e.stiffness);
}

Diagnostic refusal(const CubicLattice& wanted) {
  try {
    cubic_lattice(wanted);
  } catch (const InputError& error) {
    return error.diagnostic;
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(CubicLattice, RefusesWhatIsNoLattice) {
  const auto with = [](auto change) {
    CubicLattice wanted = lattice({2, 2, 2});
    change(wanted);
    return refusal(wanted).what;
  };
  EXPECT_THAT(with([](auto& l) { l.points[1] = 0; }), HasSubstr("axis 1 has 0 points"));
  EXPECT_THAT(with([](auto& l) { l.spacing = 0.0; }), HasSubstr("spacing (m) is 0"));
  EXPECT_THAT(with([](auto& l) { l.mass = -1.0; }), HasSubstr("mass (kg) is -1"));
  EXPECT_THAT(with([](auto& l) { l.springs.axial = -1.0; }), HasSubstr("axial"));
  EXPECT_THAT(with([](auto& l) { l.springs.face_diagonal = NAN; }), HasSubstr("face diagonal"));
  EXPECT_THAT(with([](auto& l) { l.springs.body_diagonal = INFINITY; }), HasSubstr("body"));
  EXPECT_THAT(with([](auto& l) { l.damping_per_stiffness = -1.0; }), HasSubstr("damping"));
}

}  // namespace
}  // namespace limber
