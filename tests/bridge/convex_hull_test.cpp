#include "bullet_bridge/convex_hull.h"

#include <LinearMath/btConvexHullComputer.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bullet_bridge/conversions.h"
#include "tests/bridge/measure.h"
#include "tests/bridge/random.h"

namespace limber::bullet::test {
namespace {

using Points = std::vector<Vec3>;

// Evenly about a unit ball: a golden spiral.
Points ball(int count) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  Points points;
  for (int i = 0; i < count; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - y * y);
    points.push_back({r * std::cos(golden * i), y, r * std::sin(golden * i)});
  }
  return points;
}

Points grid(int along, const Vec3& size) {
  Points points;
  for (int x = 0; x < along; ++x) {
    for (int y = 0; y < along; ++y) {
      for (int z = 0; z < along; ++z) {
        points.push_back(size.cwiseProduct(Vec3(x, y, z) / (along - 1.0) - Vec3::Constant(0.5)));
      }
    }
  }
  return points;
}

Points cloud(Random& random, int count, const Vec3& half) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(half.cwiseProduct(random.in_cube(1.0)));
  return points;
}

Points picked(const Points& points) {
  Points found;
  for (std::int32_t p : outermost(points)) found.push_back(points[p]);
  return found;
}

// How far the points reach along a unit direction, m.
double reach(const Points& points, const Vec3& direction) {
  double farthest = direction.dot(points[0]);
  for (const Vec3& p : points) farthest = std::max(farthest, direction.dot(p));
  return farthest;
}

TEST(OutermostPoints, AreTheCornersOfABrick) {
  const Points brick = grid(5, {0.4, 0.2, 0.1});
  const Points found = picked(brick);
  EXPECT_LE(found.size(), std::size_t{kSupportDirections});
  for (const Vec3& corner : grid(2, {0.4, 0.2, 0.1})) {
    EXPECT_NE(std::find(found.begin(), found.end(), corner), found.end()) << corner.transpose();
  }
}

TEST(OutermostPoints, OfABallLieInEveryDirection) {
  const Points points = ball(3000);
  const Points found = picked(points);
  EXPECT_EQ(found.size(), std::size_t{kSupportDirections});
  for (const Vec3& direction : ball(1000)) EXPECT_GT(reach(found, direction), 1.0 - 0.065);
}

TEST(ConvexHullOfPoints, HasTheirOwnPlacesForCornersAndHoldsThemAll) {
  Random random(3);
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    const Points points = cloud(random, 60, {0.1, 0.05, 0.02});
    const ConvexHull hull = convex_hull(points);
    for (const Vec3& corner : hull.corners) {
      EXPECT_NE(std::find(points.begin(), points.end(), corner), points.end());
    }
    // Bullet decides on a grid of a ten-thousandth of the size what is a corner.
    for (const HalfSpace& side : hull.sides) {
      for (const Vec3& p : points) EXPECT_LT(side.excess(p), 1e-4 * 0.2);
    }
  }
}

TEST(ConvexHullOfPoints, KnowsItsVolumeAndItsInside) {
  const ConvexHull brick = convex_hull(grid(3, {0.4, 0.2, 0.1}));
  EXPECT_NEAR(brick.volume, 0.008, 1e-12);
  EXPECT_NEAR(brick.inner_radius(), 0.05, 1e-12);
  const ConvexHull tetrahedron = convex_hull(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_NEAR(tetrahedron.volume, 1.0 / 6.0, 1e-12);
  const ConvexHull sheet = convex_hull(Points{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}});
  EXPECT_EQ(sheet.inner_radius(), 0.0);
}

TEST(InsetCorners, OfABrickAreThoseOfASmallerOne) {
  const Points inset = inset_corners(convex_hull(grid(2, {0.4, 0.2, 0.1})), 0.01);
  EXPECT_EQ(inset.size(), 8u);
  for (const Vec3& corner : grid(2, {0.38, 0.18, 0.08})) {
    EXPECT_LT((*std::min_element(inset.begin(), inset.end(),
                                 [&](const Vec3& l, const Vec3& r) {
                                   return (l - corner).norm() < (r - corner).norm();
                                 }) -
               corner)
                  .norm(),
              1e-7);
  }
}

// Two corners a millimetre apart, insets of a centimetre: one moves beyond the other's sides.
TEST(InsetCorners, OfANarrowBevelDoNotStickOut) {
  Points points;
  for (const Vec3& corner : grid(2, {0.4, 0.2, 0.2})) {
    for (int axis = 0; axis < 3; ++axis) {
      points.push_back(corner);
      points.back()[axis] *= 0.99;
    }
  }
  const Points inset = inset_corners(convex_hull(points), 0.01);
  EXPECT_EQ(inset.size(), 8u);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(reach(inset, Vec3::Unit(axis)), reach(points, Vec3::Unit(axis)) - 0.01, 1e-6);
  }
}

// The exact inset by Bullet: ten times as slow, with four times as many corners.
Points exact_inset(const Points& points, double depth) {
  std::vector<btVector3> input;
  for (const Vec3& p : points) input.push_back(to_bullet(p));
  btConvexHullComputer computer;
  computer.compute(&input[0].m_floats[0], sizeof(btVector3), static_cast<int>(input.size()),
                   static_cast<btScalar>(depth), 0);
  Points corners;
  for (int i = 0; i < computer.vertices.size(); ++i) {
    corners.push_back(from_bullet(computer.vertices[i]));
  }
  return corners;
}

// Balls about the corners, against the points they come from. m.
struct Distances {
  double outside = -1.0;  // the shape beyond the points
  double inside = -1.0;   // the points beyond the shape
};

Distances distances(const Points& points, const Points& inset, double depth) {
  Distances most;
  for (const Vec3& direction : ball(3000)) {
    const double beyond = reach(inset, direction) + depth - reach(points, direction);
    most.outside = std::max(most.outside, beyond);
    most.inside = std::max(most.inside, -beyond);
  }
  return most;
}

std::vector<Points> pieces() {
  Random random(4);
  std::vector<Points> pieces = {ball(500), grid(2, {2, 1, 0.5})};
  Points dented = grid(6, {2, 2, 2});
  for (Vec3& p : dented) p += random.in_cube(0.02);
  pieces.push_back(dented);
  Points needle = ball(200);
  needle.push_back({0, 6, 0});
  pieces.push_back(needle);
  for (int count : {5, 10, 20, 50, 200}) {
    for (int k = 0; k < 10; ++k) {
      const Points points = cloud(random, count, {1.0, 0.5, 1.0});
      if (convex_hull(picked(points)).inner_radius() > 0.01) pieces.push_back(points);
    }
  }
  return pieces;
}

// What it saves over the exact inset is paid at corners of more than three sides, and there at most
// with a margin.
TEST(InsetCorners, StayBehindAllSidesAndNearlyAsCloseAsTheExactInset) {
  double sum = 0.0;  // of what they are farther inside, in depths
  for (const Points& points : pieces()) {
    SCOPED_TRACE(points.size());
    const ConvexHull hull = convex_hull(picked(points));
    const double depth = std::min(0.05, 0.4 * hull.inner_radius());
    const Points inset = inset_corners(hull, depth);
    const Distances mine = distances(points, inset, depth);
    const Distances exact = distances(points, exact_inset(picked(points), depth), depth);
    EXPECT_LT(mine.outside, 1e-5);  // of 1 m
    EXPECT_LT(mine.inside, exact.inside + depth + 1e-5);
    EXPECT_LE(inset.size(), hull.corners.size());
    sum += (mine.inside - exact.inside) / depth;
  }
  EXPECT_GT(pieces().size(), 45u);
  EXPECT_LT(sum / static_cast<double>(pieces().size()), 0.05);
}

}  // namespace
}  // namespace limber::bullet::test
