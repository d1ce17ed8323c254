#include "core/modeller/thin_material.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/analysis/periodic_lattice.h"
#include "core/dynamics/stable_step.h"
#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/modeller/box_lattice.h"
#include "core/modeller/particle_cloud.h"
#include "core/modeller/rope.h"
#include "core/modeller/sheet.h"

namespace limber {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kThickness = 2e-3;  // m
constexpr double kSpacing = 0.1;     // m
const double kRowHeight = std::sqrt(3.0) / 2.0 * kSpacing;

Material rubber() {
  Material m;
  m.density = 1100.0;
  m.youngs_modulus = 3e6;
  m.strain_at_break = 0.5;
  m.strain_at_crush = 0.25;
  m.damping_ratio = 0.1;
  m.internal_damping = 2.0;
  m.friction = 0.8;
  m.restitution = 0.3;
  m.softening = 4.0;
  return m;
}
const double kStretch = 3e6 / 4.0 * kThickness;  // N/m, E t of the softened material

GeometricModel flat_sheet(int n, SheetCells cells) {
  const double row = cells == SheetCells::kTriangles ? kRowHeight : kSpacing;
  return sheet(
      [=](double u, double v) -> Vec3 {
        return {n * kSpacing * u, n * row * v, 0.0};
      },
      {n, n, cells, false}, "sheet");
}

// The point nearest to the middle, and the sheet's area for each point there.
PointId middle_of(const GeometricModel& g) {
  const Vec3 centre = 0.5 * (g.points.raw().front() + g.points.raw().back());
  PointId nearest(std::size_t{0});
  for (PointId p : ids_of(g.points)) {
    if ((g.points[p] - centre).norm() < (g.points[nearest] - centre).norm()) nearest = p;
  }
  return nearest;
}

TEST(RopeMaterial, SegmentsAreBars) {
  const std::vector<Vec3> points = {{0, 0, 0}, {0.5, 0, 0}, {0.5, 0.25, 0}};
  const double section = round_section(0.01);
  EXPECT_NEAR(section, 7.85398163e-5, 1e-13);
  const PhysicalModel m = with_rope_material(rope(points, "rope"), "rope", rubber(), section);
  EXPECT_TRUE(validate(m).empty());
  const EdgeAttributes& first = m.edges[EdgeId(std::size_t{0})];
  EXPECT_NEAR(first.stiffness, 3e6 / 4.0 * section / 0.5, 1e-9);
  EXPECT_NEAR(m.edges[EdgeId(std::size_t{1})].stiffness, 2.0 * first.stiffness, 1e-9);
  EXPECT_NEAR(first.break_threshold, 0.5 * 2.0 * 0.5, 1e-15);  // strain x sqrt(S) x length
  EXPECT_NEAR(first.crush_threshold, 0.25 * 2.0 * 0.5, 1e-15);
  const double line_density = 1100.0 * section;
  EXPECT_NEAR(m.points[PointId(std::size_t{0})].mass, 0.25 * line_density, 1e-15);
  EXPECT_NEAR(m.points[PointId(std::size_t{1})].mass, 0.375 * line_density, 1e-15);
  EXPECT_NEAR(total_mass(m), 0.75 * line_density, 1e-15);
}

TEST(RopeMaterial, ObjectHasTheMaterialsValues) {
  const std::vector<Vec3> points = {{0, 0, 0}, {0.5, 0, 0}, {0.5, 0.25, 0}};
  const PhysicalModel m = with_rope_material(rope(points, "rope"), "rope", rubber(), 1e-4);
  EXPECT_EQ(m.object.friction, 0.8);
  EXPECT_EQ(m.object.restitution, 0.3);
  EXPECT_EQ(m.object.internal_damping, 2.0);
  EXPECT_EQ(m.object.softening, 4.0);
  const EdgeAttributes& e = m.edges[EdgeId(std::size_t{0})];
  EXPECT_NEAR(e.damping / e.stiffness, 2.0 * 0.1 / highest_frequency(m).omega_max, 1e-12);
}

TEST(SheetMaterial, EquilateralTrianglesHaveTheClosedForm) {
  const GeometricModel g = flat_sheet(8, SheetCells::kTriangles);
  const PhysicalModel m = with_sheet_material(g, "sheet", rubber(), {.thickness = kThickness});
  EXPECT_TRUE(validate(m).empty());
  const PointId middle = middle_of(g);
  int inner = 0;
  for (EdgeId e : ids_of(g.edges)) {
    if (g.edges[e].a != middle && g.edges[e].b != middle) continue;
    EXPECT_NEAR(m.edges[e].stiffness, std::sqrt(3.0) / 2.0 * kStretch, 1e-9 * kStretch);
    ++inner;
  }
  EXPECT_EQ(inner, 6);
}

// Sides of two squares and diagonals of one: k1 + k2 = A_1111 = 9/8 Et and k2 = A_1122 = 3/8 Et.
TEST(SheetMaterial, SquaresHaveTheClosedForm) {
  const GeometricModel g = flat_sheet(8, SheetCells::kSquares);
  const PhysicalModel m = with_sheet_material(g, "sheet", rubber(), {.thickness = kThickness});
  const PointId middle = middle_of(g);
  for (EdgeId e : ids_of(g.edges)) {
    const auto& [a, b] = g.edges[e];
    if (a != middle && b != middle) continue;
    const bool diagonal = (g.points[a] - g.points[b]).norm() > 1.1 * kSpacing;
    EXPECT_NEAR(m.edges[e].stiffness, (diagonal ? 0.375 : 0.75) * kStretch, 1e-9 * kStretch);
  }
}

// The tensor of plane stress, by another way: E t / (1 - nu^2) and so on, for nu = 1/3.
TEST(SheetMaterial, BulkIsThatOfPlaneStress) {
  for (SheetCells cells : {SheetCells::kTriangles, SheetCells::kSquares}) {
    const GeometricModel g = flat_sheet(8, cells);
    const PhysicalModel m = with_sheet_material(g, "sheet", rubber(), {.thickness = kThickness});
    const double row = cells == SheetCells::kTriangles ? kRowHeight : kSpacing;
    const double volume = kSpacing * row * kThickness;
    const ElasticityMatrix c = elasticity(lattice_around(m, middle_of(g), volume));
    const double modulus = 3e6 / 4.0, nu = 1.0 / 3.0;
    EXPECT_NEAR(c(0, 0), modulus / (1.0 - nu * nu), 1e-8 * modulus);
    EXPECT_NEAR(c(1, 1), c(0, 0), 1e-8 * modulus);
    EXPECT_NEAR(c(0, 1), nu * modulus / (1.0 - nu * nu), 1e-8 * modulus);
    EXPECT_NEAR(c(5, 5), modulus / (2.0 * (1.0 + nu)), 1e-8 * modulus);
    EXPECT_NEAR(c(0, 5), 0.0, 1e-8 * modulus);
  }
}

// Whatever the shape, equal strain in both directions meets E t / (1 - nu) = 3/2 E t:
// sum_e k_e l_e^2 = 3 E t area. Where the nearest tensor would need a spring that pushes apart
// (obtuse angles), there is none.
TEST(SheetMaterial, CellsOfAnyShapeHaveTheTrace) {
  const std::vector<std::vector<Vec3>> triangles = {{{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}},
                                                    {{3, 0, 0}, {0, 0.4, 0}, {-3, -0.4, 0}},
                                                    {{2, 0, 0}, {-1, 0.3, 0}, {-1, -0.3, 0}}};
  for (const std::vector<Vec3>& edges : triangles) {
    const double area = 0.5 * edges[0].cross(edges[1]).norm();
    const std::vector<double> k = isotropic_sheet_stiffness(edges, Vec3::UnitZ(), area, 5.0);
    double trace = 0.0;
    for (std::size_t e = 0; e < 3; ++e) {
      EXPECT_GE(k[e], 0.0);
      trace += k[e] * edges[e].squaredNorm();
    }
    EXPECT_NEAR(trace, 3.0 * 5.0 * area, 1e-12);
  }
}

// The fit does not depend on how the cell lies in space, nor on the order of edges.
TEST(SheetMaterial, IsTheSameTurned) {
  const std::vector<Vec3> edges = {{1, 0, 0}, {-0.3, 0.9, 0}, {-0.7, -0.9, 0}};
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const std::vector<Vec3> turned = {turn * edges[2], turn * edges[0], turn * edges[1]};
  const auto k = isotropic_sheet_stiffness(edges, Vec3::UnitZ(), 0.45, 1.0);
  const auto k2 = isotropic_sheet_stiffness(turned, turn * Vec3(0, 0, -7), 0.45, 1.0);
  EXPECT_NEAR(k[0], k2[1], 1e-9);
  EXPECT_NEAR(k[1], k2[2], 1e-9);
  EXPECT_NEAR(k[2], k2[0], 1e-9);
}

TEST(SheetMaterial, MassIsDensityTimesVolumeAndDragIsAsStated) {
  const GeometricModel g = flat_sheet(5, SheetCells::kTriangles);
  const FaceAttributes drag{DragLaw::kQuadratic, 1.2, 0.1};
  const PhysicalModel m = with_sheet_material(g, "sheet", rubber(), {kThickness, drag});
  EXPECT_NEAR(total_mass(m), 1100.0 * kThickness * (5 * kSpacing) * (5 * kRowHeight), 1e-12);
  for (const FaceAttributes& face : m.faces) {
    EXPECT_EQ(face.normal_drag, 1.2);
    EXPECT_EQ(face.tangential_drag, 0.1);
  }
  EXPECT_EQ(m.object.softening, 4.0);
}

TEST(Particles, AreBalls) {
  const std::vector<Vec3> places = {{0, 0, 0}, {1, 0, 0}};
  const Particle ball = ball_particle(2000.0, 0.1);
  EXPECT_NEAR(ball.mass, 8.3775804, 1e-7);
  const PhysicalModel m = with_particles(particle_cloud(places, "sand"), "sand", ball);
  EXPECT_TRUE(validate(m).empty());
  EXPECT_EQ(m.object.particle_radius, 0.1);
  for (const PointAttributes& p : m.points) EXPECT_EQ(p.mass, ball.mass);
}

TEST(ThinMaterialErrors, NameTheDefect) {
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 0, 0}};
  const GeometricModel string = rope(line, "rope");
  const GeometricModel plane = flat_sheet(2, SheetCells::kTriangles);
  const GeometricModel solid = box_lattice({1, 1, 1}, {1, 1, 1}, Vec3::Zero(), "box");
  const auto sheet_of = [](const GeometricModel& g, double t) {
    return [=] { with_sheet_material(g, "m", rubber(), {.thickness = t}); };
  };
  EXPECT_THAT(sheet_of(solid, 1.0), ThrowsMessage<InputError>(HasSubstr("it is closed")));
  EXPECT_THAT(sheet_of(string, 1.0), ThrowsMessage<InputError>(HasSubstr("belongs to no cell")));
  EXPECT_THAT(sheet_of(plane, 0.0), ThrowsMessage<InputError>(HasSubstr("thickness is 0 m")));
  EXPECT_THAT([&] { with_rope_material(plane, "m", rubber(), 1.0); },
              ThrowsMessage<InputError>(HasSubstr("it has 10 cells")));
  EXPECT_THAT([&] { with_rope_material(particle_cloud(line, "p"), "m", rubber(), 1.0); },
              ThrowsMessage<InputError>(HasSubstr("it belongs to no edge")));
  EXPECT_THROW(with_rope_material(string, "m", Material(), 1.0), InputError);
  EXPECT_THROW(with_rope_material(string, "m", rubber(), NAN), InputError);
  EXPECT_THROW(with_particles(string, "m", ball_particle(1, 1)), InputError);
  EXPECT_THROW(with_particles(particle_cloud(line, "p"), "m", {.mass = 0.0}), InputError);
  EXPECT_THROW(with_particles(particle_cloud(line, "p"), "m", {1.0, -1.0}), InputError);
  EXPECT_THROW(with_particles(particle_cloud(line, "p"), "m", {1.0, 1.0, NAN}), InputError);
  EXPECT_THROW(ball_particle(0.0, 1.0), InputError);
  EXPECT_THROW(round_section(-1.0), InputError);
}

}  // namespace
}  // namespace limber
