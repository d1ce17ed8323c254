#include "core/modeller/round_solids.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/modeller/cell_stiffness.h"
#include "core/operators/boundary_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"

namespace limber {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kRadius = 0.7;   // m
constexpr double kHeight = 1.9;   // m
const Vec3 kFar(1e4, -3e4, 2e4);  // m

double profile_of_vase(double y) { return 0.5 + 0.2 * std::sin(2.0 * y); }
double profile_of_egg(double y) {
  return 0.5 * std::sqrt(std::max(0.0, 1.0 - y * y)) * (1.0 - 0.15 * y);
}
double profile_of_bullet(double y) {
  return y < 1.0 ? 0.5 : 0.5 * std::sqrt(std::max(0.0, 1.0 - 4.0 * (y - 1.0) * (y - 1.0)));
}

// Closed forms: pi times the integral of the squared profile.
struct Shape {
  const char* name;
  std::function<GeometricModel(int cells_across)> make;
  double volume;        // m^3
  double longest;       // edge of a cell / its shortest one along the cell's axes, at most
  double least_corner;  // scaled Jacobian: volume of the unit vectors along a corner's three edges
};

Shape revolved(const char* name, double (*profile)(double), double low, double high, double volume,
               double longest, double least_corner) {
  const auto make = [=](int n) {
    return solid_of_revolution(
        {.radius = profile, .y_low = low, .y_high = high, .origin = kFar, .cells_across = n}, name);
  };
  return {name, make, volume, longest, least_corner};
}

std::vector<Shape> shapes() {
  const auto sphere = [](int n) {
    return solid_sphere({.centre = kFar, .radius = kRadius, .cells_across = n}, "sphere");
  };
  const auto cylinder = [](int n) {
    return solid_cylinder({.base = kFar, .radius = kRadius, .height = kHeight, .cells_across = n},
                          "cylinder");
  };
  const double vase =
      pi * (0.25 * 3.0 + 0.2 * (1.0 - std::cos(6.0)) / 2.0 + 0.04 * (1.5 - std::sin(12.0) / 8.0));
  const double egg = pi * 0.25 * (4.0 / 3.0 + 0.0225 * (2.0 / 3.0 - 2.0 / 5.0));
  return {
      {"sphere", sphere, 4.0 / 3.0 * pi * std::pow(kRadius, 3), 2.1, 0.68},
      {"cylinder", cylinder, pi * kRadius * kRadius * kHeight, 2.0, 0.77},
      revolved("vase", profile_of_vase, 0.0, 3.0, vase, 3.0, 0.6),
      revolved("egg", profile_of_egg, -1.0, 1.0, egg, 3.0, 0.55),
      revolved("bullet", profile_of_bullet, 0.0, 1.5, pi * 0.25 * (1.0 + 1.0 / 3.0), 2.3, 0.65)};
}

class RoundSolids : public testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, RoundSolids, testing::ValuesIn(shapes()),
                         [](const auto& shape) { return std::string(shape.param.name); });

double volume(const GeometricModel& g) {
  double sum = 0.0;
  for (CellId c : ids_of(g.cells)) sum += cell_volume(g, c);
  return sum;
}

TEST_P(RoundSolids, AreValidFarFromTheOrigin) {
  for (int n : {4, 5, 6, 7, 8}) {
    EXPECT_THAT(validate(GetParam().make(n), GetParam().name), testing::IsEmpty()) << n;
  }
}

TEST_P(RoundSolids, VolumeConvergesWithTheSquareOfTheCellSize) {
  const auto error = [&](int n) { return GetParam().volume - volume(GetParam().make(n)); };
  EXPECT_LT(error(16), 0.025 * GetParam().volume);
  // 2, 4 and 8 cells along a quarter of the circumference.
  EXPECT_NEAR(error(4) / error(8), 4.0, 0.5);
  EXPECT_NEAR(error(8) / error(16), 4.0, 0.25);
}

TEST_P(RoundSolids, SurfaceIsThatOfABall) {
  const SurfaceModel surface =
      boundary(test::with_plausible_attributes(GetParam().make(6), GetParam().name));
  EXPECT_EQ(test::unmatched_sides(surface), 0);
  const int sides = 3 * int(surface.triangles.size()) / 2;
  EXPECT_EQ(int(surface.points.size()) - sides + int(surface.triangles.size()), 2);
  EXPECT_GT(test::enclosed_volume(surface), 0.0);
}

// The corners of a cell, found by their edges to the first one: 0-1, 0-2, ... 0-7 come first.
std::array<Vec3, 8> corners_of(const GeometricModel& g, const Cell& cell) {
  const Edge& first = g.edges[cell.edges[0]];
  const Edge& second = g.edges[cell.edges[1]];
  const PointId origin = first.a == second.a || first.a == second.b ? first.a : first.b;
  std::array<Vec3, 8> corners;
  corners[0] = g.points[origin];
  for (std::size_t i = 0; i < 7; ++i) {
    const Edge& e = g.edges[cell.edges[i]];
    corners[i + 1] = g.points[e.a == origin ? e.b : e.a];
  }
  return corners;
}

TEST_P(RoundSolids, CellsAreWellShaped) {
  for (int n : {4, 8, 12}) {
    const GeometricModel g = GetParam().make(n);
    double longest = 0.0, least_corner = 1.0;
    for (const Cell& cell : g.cells) {
      const std::array<Vec3, 8> x = corners_of(g, cell);
      double lowest = INFINITY, highest = 0.0;
      for (std::size_t c = 0; c < 8; ++c) {
        Mat3 along;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Vec3 edge = (x[c ^ (1u << axis)] - x[c]) * ((c >> axis & 1u) != 0 ? -1.0 : 1.0);
          lowest = std::min(lowest, edge.norm());
          highest = std::max(highest, edge.norm());
          along.col(int(axis)) = edge.normalized();
        }
        least_corner = std::min(least_corner, along.determinant());
      }
      longest = std::max(longest, highest / lowest);
    }
    EXPECT_LT(longest, GetParam().longest) << n;
    EXPECT_GT(least_corner, GetParam().least_corner) << n;
  }
}

// What well-shaped cells are for: their springs carry the material.
TEST(SolidSphere, CellsAreNearlyIsotropic) {
  const GeometricModel g = solid_sphere({.radius = kRadius, .cells_across = 12}, "sphere");
  for (CellId c : ids_of(g.cells)) {
    std::vector<Vec3> edges;
    for (EdgeId e : g.cells[c].edges) {
      edges.push_back(g.points[g.edges[e].b] - g.points[g.edges[e].a]);
    }
    const double v = cell_volume(g, c);
    EXPECT_LT(anisotropy(edges, isotropic_cell_stiffness(edges, v, 1.0), v, 1.0), 0.06);
  }
}

TEST(SolidOfRevolution, SurfacePointsLieOnTheSurface) {
  const GeometricModel g = solid_of_revolution(
      {.radius = profile_of_egg, .y_low = -1.0, .y_high = 1.0, .cells_across = 8}, "egg");
  const SurfaceModel surface = boundary(test::with_plausible_attributes(g, "egg"));
  for (const Vec3& p : surface.points) {
    const double r = std::hypot(p.x(), p.z());
    EXPECT_NEAR(r * r, std::pow(profile_of_egg(p.y()), 2), 1e-12);
  }
}

TEST(SolidSphere, SurfacePointsLieOnTheSphere) {
  const GeometricModel g = solid_sphere({.radius = kRadius, .cells_across = 8}, "sphere");
  const SurfaceModel surface = boundary(test::with_plausible_attributes(g, "sphere"));
  for (const Vec3& p : surface.points) EXPECT_NEAR(p.norm(), kRadius, 1e-14);
}

// A sphere by its profile is the sphere, as long as the cells are wanted as many.
TEST(SolidOfRevolution, OfACircleIsTheSphere) {
  const auto circle = [](double y) { return std::sqrt(std::max(0.0, 1.0 - y * y)); };
  const GeometricModel revolved = solid_of_revolution(
      {.radius = circle, .y_low = -1.0, .y_high = 1.0, .cells_across = 8}, "ball");
  const GeometricModel ball = solid_sphere({.radius = 1.0, .cells_across = 8}, "ball");
  ASSERT_EQ(revolved.points.size(), ball.points.size());
  for (PointId p : ids_of(ball.points)) {
    EXPECT_LT((revolved.points[p] - ball.points[p]).norm(), 1e-6);
  }
}

// Ends that are tips: a double cone.
TEST(SolidOfRevolution, TipsAreClosed) {
  const auto cones = [](double y) { return 1.0 - std::abs(y); };
  for (int n : {4, 7, 12}) {
    const GeometricModel g = solid_of_revolution(
        {.radius = cones, .y_low = -1.0, .y_high = 1.0, .cells_across = n}, "cones");
    EXPECT_TRUE(validate(g, "cones").empty());
    EXPECT_NEAR(volume(g), 2.0 / 3.0 * pi, 3.0 / (n * n) * pi);
  }
}

TEST(RoundSolidErrors, NameTheDefect) {
  EXPECT_THAT([] { solid_sphere({.radius = 1.0, .cells_across = 3}, "ball"); },
              ThrowsMessage<InputError>(HasSubstr("there are 3 cells across; give at least 4")));
  EXPECT_THAT([] { solid_sphere({.radius = 1.0, .cells_across = 2000}, "ball"); },
              ThrowsMessage<InputError>(HasSubstr("points, more than 20000000; give fewer cells")));
  EXPECT_THROW(solid_sphere({.radius = -1.0}, "ball"), InputError);
  EXPECT_THROW(solid_sphere({.centre = {NAN, 0, 0}, .radius = 1.0}, "ball"), InputError);
  EXPECT_THROW(solid_cylinder({.radius = 1.0, .height = INFINITY}, "rod"), InputError);
  EXPECT_THROW(solid_cylinder({.radius = 1e-9, .height = 1e9}, "rod"), InputError);
  EXPECT_THROW(solid_cylinder({.radius = 1, .height = 1, .cells_along = -1}, "rod"), InputError);
  const auto revolve = [](std::function<double(double)> r, double low, double high) {
    return [=] { solid_of_revolution({.radius = r, .y_low = low, .y_high = high}, "solid"); };
  };
  const auto one = [](double) { return 1.0; };
  EXPECT_THAT(revolve([](double y) { return y * y - 0.25; }, -1.0, 1.0),
              ThrowsMessage<InputError>(HasSubstr("above 0 between the ends")));
  EXPECT_THROW(revolve(one, 1.0, 1.0)(), InputError);
  EXPECT_THROW(revolve(one, 0.0, NAN)(), InputError);
  EXPECT_THROW(revolve([](double) { return double(NAN); }, 0.0, 1.0)(), InputError);
  EXPECT_THROW(revolve(nullptr, 0.0, 1.0)(), InputError);
}

}  // namespace
}  // namespace limber
