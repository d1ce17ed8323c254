#include "core/modeller/rope.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/model/errors.h"
#include "core/model/validate.h"

namespace limber {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Helix of radius 1 and pitch 1: length sqrt((2 pi)^2 + 1) a turn.
Vec3 helix(double t) {
  const double angle = 2.0 * std::numbers::pi * t * t;  // not at a steady pace
  return {std::cos(angle), t * t, std::sin(angle)};
}
const double kHelixLength = std::hypot(2.0 * std::numbers::pi, 1.0);

double length_of_edges(const GeometricModel& g) {
  double sum = 0.0;
  for (const auto& [a, b] : g.edges) sum += (g.points[b] - g.points[a]).norm();
  return sum;
}

TEST(Rope, JoinsItsPointsInOrder) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 1}};
  const GeometricModel open = rope(points, "rope"), ring = rope(points, "ring", RopeEnds::kJoined);
  EXPECT_EQ(open.edges.size(), 3u);
  EXPECT_EQ(ring.edges.size(), 4u);
  EXPECT_EQ(open.points.raw(), points);
  EXPECT_EQ(open.cells.size() + open.faces.size(), 0u);
  EXPECT_TRUE(validate(open, "rope").empty());
  EXPECT_TRUE(validate(ring, "ring").empty());
}

TEST(Rope, SegmentsOfACurveAreEquallyLong) {
  const GeometricModel g = rope(points_along(helix, 50), "helix");
  const auto length = [&](const Edge& e) { return (g.points[e.b] - g.points[e.a]).norm(); };
  const double first = length(g.edges[EdgeId(std::size_t{0})]);
  for (const Edge& e : g.edges) EXPECT_NEAR(length(e), first, 1e-4 * first);
  EXPECT_EQ(g.points.raw().front(), helix(0.0));
  EXPECT_EQ(g.points.raw().back(), helix(1.0));
}

// The error of chords: a quarter for twice as many.
TEST(Rope, LengthConvergesToTheCurves) {
  const auto error = [](int n) {
    return kHelixLength - length_of_edges(rope(points_along(helix, n), "helix"));
  };
  EXPECT_NEAR(error(20) / error(40), 4.0, 0.1);
  EXPECT_NEAR(error(40) / error(80), 4.0, 0.1);
  EXPECT_NEAR(curve_length(helix), kHelixLength, 1e-6);
  EXPECT_EQ(segments_of(helix, kHelixLength / 33.2), 33);
  EXPECT_EQ(segments_of(helix, 100.0), 1);
}

TEST(Rope, APolylineIsWalkedAtASteadyPace) {
  const Curve corner = polyline({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}});
  EXPECT_TRUE(corner(0.5).isApprox(Vec3(2, 0, 0)));
  EXPECT_TRUE(corner(0.75).isApprox(Vec3(3, 0, 0)));
  EXPECT_TRUE(corner(1.0).isApprox(Vec3(3, 1, 0)));
  EXPECT_NEAR(curve_length(corner), 4.0, 1e-12);
}

TEST(Rope, RefusesWhatIsNoRope) {
  const std::vector<Vec3> twice = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  EXPECT_THAT([&] { rope(twice, "rope"); },
              ThrowsMessage<InputError>(HasSubstr("points 1 and 2 are in the same place")));
  EXPECT_THROW(rope(std::vector<Vec3>{{0, 0, 0}}, "rope"), InputError);
  EXPECT_THROW(rope(std::vector<Vec3>{{0, 0, 0}, {NAN, 0, 0}}, "rope"), InputError);
  EXPECT_THROW(rope(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, "ring", RopeEnds::kJoined),
               InputError);
  EXPECT_THROW(polyline({{0, 0, 0}}), InputError);
  EXPECT_THROW(points_along(helix, 0), InputError);
  EXPECT_THAT([] { points_along(helix, 2000000000); },
              ThrowsMessage<InputError>(HasSubstr("2e+09 points")));
  EXPECT_THROW(segments_of(helix, 0.0), InputError);
  EXPECT_THROW(segments_of(helix, 1e-12), InputError);
  EXPECT_THROW(points_along([](double) -> Vec3 { return Vec3::Zero(); }, 3), InputError);
}

}  // namespace
}  // namespace limber
