#include "core/modeller/ring_shell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/operators/boundary_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"

namespace limber {
namespace {

using std::numbers::pi;

Vec3 around_y(double u, double radius, double height) {
  return {radius * std::cos(2.0 * pi * u), height, radius * std::sin(2.0 * pi * u)};
}

// From the lower pole to the upper one.
RingSurface sphere(double radius) {
  const auto normal = [](double u, double v) {
    return around_y(u, std::sin(pi * v), -std::cos(pi * v));
  };
  return {[=](double u, double v) -> Vec3 { return radius * normal(u, v); }, normal};
}

RingSurface cylinder(double radius, double height) {
  return {[=](double u, double v) { return around_y(u, radius, height * v); },
          [](double u, double) { return around_y(u, 1.0, 0.0); }};
}

// Half of a torus: u goes around the tube, v half-way around the axis y.
RingSurface half_torus(double big_radius, double tube_radius) {
  const auto normal = [](double u, double v) -> Vec3 {
    const Vec3 out(std::cos(pi * v), 0.0, std::sin(pi * v));
    return std::cos(2.0 * pi * u) * out + std::sin(2.0 * pi * u) * Vec3::UnitY();
  };
  const auto position = [=](double u, double v) -> Vec3 {
    const Vec3 out(std::cos(pi * v), 0.0, std::sin(pi * v));
    return big_radius * out + tube_radius * normal(u, v);
  };
  return {position, normal};
}

GeometricModel shell(const RingSurface& surface, const RingShellOptions& options) {
  GeometricModelBuilder builder;
  builder.begin_subobject("shell");
  add_ring_shell(builder, surface, options);
  return builder.finish();
}

double volume_of(const GeometricModel& g) {
  double volume = 0.0;
  for (CellId c : ids_of(g.cells)) {
    EXPECT_GT(cell_volume(g, c), 0.0);
    volume += cell_volume(g, c);
  }
  return volume;
}

SurfaceModel surface_of(const GeometricModel& g) {
  return boundary(test::with_plausible_attributes(g, "shell"));
}

// V - E + F of a closed surface of triangles, each side shared by two.
int euler_characteristic(const SurfaceModel& s) {
  const int triangles = static_cast<int>(s.triangles.size());
  return static_cast<int>(s.points.size()) - 3 * triangles / 2 + triangles;
}

double sphere_shell(double radius, double thickness) {
  return 4.0 / 3.0 * pi * (std::pow(radius, 3) - std::pow(radius - thickness, 3));
}

constexpr double kRadius = 0.05;  // m
constexpr double kWall = 0.005;   // m

// Equilateral triangles of side s in a sphere: their circumradius is r = s / sqrt 3, they lie
// r^2 / (2 R) below it and miss 5/8 (r / R)^2 of its area, so that the volume between two such
// polyhedra lacks 9/8 (r / R)^2 = 3/8 (s / R)^2.
TEST(RingShell, OfASphereHasItsVolumeUpToTheFlatnessOfTriangles) {
  const double exact = sphere_shell(kRadius, kWall);
  for (double spacing : {0.01, 0.005, 0.0025}) {
    const double volume = volume_of(shell(sphere(kRadius), {spacing, kWall}));
    const double expected = 0.375 * std::pow(spacing / kRadius, 2);
    EXPECT_NEAR((exact - volume) / exact / expected, 1.0, 0.1) << spacing;
  }
}

// A regular n-gon in the circle, n = 63: sin(2 pi / n) n / (2 pi) = 1 - 0.0017.
TEST(RingShell, OfACylinderHasItsVolumeUpToThePolygon) {
  const double volume = volume_of(shell(cylinder(kRadius, 0.1), {0.005, kWall}));
  const double exact = pi * (kRadius * kRadius - std::pow(kRadius - kWall, 2)) * 0.1;
  EXPECT_NEAR(volume / exact, std::sin(2.0 * pi / 63) * 63 / (2.0 * pi), 0.001);
}

// Pappus: the area of the wall's section times the way of its centre.
TEST(RingShell, OfAHalfTorusHasItsVolumeUpToThePolygons) {
  const double tube = 0.02;
  const double volume = volume_of(shell(half_torus(kRadius, tube), {0.004, 0.003}));
  const double exact = pi * (tube * tube - std::pow(tube - 0.003, 2)) * pi * kRadius;
  EXPECT_NEAR(volume / exact, 1.0, 0.015);
  EXPECT_LT(volume, exact);
}

TEST(RingShell, IsClosedWithTheTopologyOfItsShape) {
  const struct {
    RingSurface surface;
    double v_end;
    int euler;
  } cases[] = {{cylinder(kRadius, 0.1), 1.0, 0},  // a thick tube is a torus
               {sphere(kRadius), 1.0, 4},         // two spheres, one within the other
               {sphere(kRadius), 0.6, 2},         // a bowl is a ball
               {half_torus(kRadius, 0.02), 1.0, 0}};
  for (const auto& [surface, v_end, euler] : cases) {
    const SurfaceModel s = surface_of(shell(surface, {0.006, kWall, 0.0, v_end}));
    EXPECT_EQ(test::unmatched_sides(s), 0);
    EXPECT_EQ(euler_characteristic(s), euler);
  }
}

TEST(RingShell, BoundaryHoldsTheVolumeOfTheCells) {
  const GeometricModel g = shell(sphere(kRadius), {0.006, kWall});
  EXPECT_NEAR(test::enclosed_volume(surface_of(g)), volume_of(g), 1e-15);
}

TEST(RingShell, IsAValidModel) {
  EXPECT_TRUE(validate(shell(sphere(kRadius), {0.006, kWall}), "sphere").empty());
  EXPECT_TRUE(validate(shell(cylinder(kRadius, 0.1), {0.006, kWall}), "cylinder").empty());
}

TEST(RingShell, CellsArePrismsOf15EdgesAnd8Faces) {
  const GeometricModel g = shell(cylinder(kRadius, 0.1), {0.006, kWall});
  for (const Cell& cell : g.cells) {
    EXPECT_EQ(cell.edges.size(), 15u);
    EXPECT_EQ(cell.faces.size(), 8u);
  }
}

TEST(RingShell, TurnsOutwardWhicheverWayTheParametersRun) {
  const RingSurface tube = cylinder(kRadius, 0.1);
  const RingSurface mirrored = {[=](double u, double v) { return tube.position(1.0 - u, v); },
                                [=](double u, double v) { return tube.normal(1.0 - u, v); }};
  EXPECT_NEAR(volume_of(shell(mirrored, {0.006, kWall})), volume_of(shell(tube, {0.006, kWall})),
              1e-8);
}

TEST(RingShell, NeighboursAreAboutASpacingApart) {
  const double spacing = 0.006;
  const GeometricModel g = shell(cylinder(kRadius, 0.1), {spacing, kWall});
  for (const Face& face : g.faces) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 side = g.points[face.corners[(i + 1) % 3]] - g.points[face.corners[i]];
      EXPECT_GT(side.norm(), 0.7 * std::min(spacing, kWall));
      EXPECT_LT(side.norm(), 1.5 * spacing);
    }
  }
}

TEST(RingShell, PoleIsOnePointOnTheAxis) {
  const GeometricModel g = shell(sphere(kRadius), {0.006, kWall});
  int on_axis = 0;
  for (const Vec3& p : g.points) on_axis += std::hypot(p.x(), p.z()) < 1e-12;
  EXPECT_EQ(on_axis, 4);  // outer and inner, at both ends
}

// Outside 8 mm and inside 2 mm in radius: with 12 points the inner ones would be 1 mm apart.
TEST(RingShell, NarrowTubeKeepsItsInnerPointsApart) {
  const double spacing = 0.004;
  const GeometricModel g = shell(cylinder(0.008, 0.04), {spacing, 0.006});
  for (const Edge& e : g.edges) {
    EXPECT_GT((g.points[e.b] - g.points[e.a]).norm(), 0.45 * spacing);
  }
}

TEST(RingShell, RefusesLengthsThatAreNone) {
  EXPECT_THROW(shell(sphere(kRadius), {0.0, kWall}), InputError);
  EXPECT_THROW(shell(sphere(kRadius), {0.006, NAN}), InputError);
  EXPECT_THROW(shell(sphere(kRadius), {0.006, kWall, 0.5, 0.5}), InputError);
}

}  // namespace
}  // namespace limber
