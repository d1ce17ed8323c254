#include "bullet_bridge/shapes/shape_cache.h"

#include <gtest/gtest.h>

#include "bullet_bridge/shapes/convex_planes.h"
#include "tests/bridge/shapes.h"

namespace limber::bullet::test {
namespace {

TEST(ShapeCache, GivesTheSamePlanesAgain) {
  ShapeCache cache;
  const auto hull = hull_of(sphere_points(50, 0.5)), twin = hull_of(sphere_points(50, 0.5));
  const auto first = cache.planes_of(*hull);
  EXPECT_EQ(cache.planes_of(*hull), first);
  EXPECT_EQ(cache.planes_of(*twin), first);
  EXPECT_EQ(cache.size(), 1u);
}

// As a freed shape's address comes again.
TEST(ShapeCache, KnowsAShapeByItsContents) {
  ShapeCache cache;
  const auto hull = hull_of(box_corners({0.5, 0.5, 0.5}));
  hull->setMargin(0);
  EXPECT_NEAR(cache.planes_of(*hull)->penetration(Vec3::Zero(), 0.0).depth, 0.5, 1e-7);
  *hull = *hull_of(box_corners({0.3, 0.5, 0.5}));
  EXPECT_NEAR(cache.planes_of(*hull)->penetration(Vec3::Zero(), 0.0).depth, 0.3, 1e-7);
  hull->setLocalScaling(bt(1, 0.2, 1));
  EXPECT_NEAR(cache.planes_of(*hull)->penetration(Vec3::Zero(), 0.0).depth, 0.1, 1e-7);
}

TEST(ShapeCache, ForgetsWhatWasNotAskedForTheLongest) {
  ShapeCache cache(3);
  std::vector<std::unique_ptr<btConvexHullShape>> hulls;
  for (int i = 0; i < 4; ++i) hulls.push_back(hull_of(box_corners(Vec3::Constant(0.1 * (i + 1)))));
  const auto a = cache.planes_of(*hulls[0]), b = cache.planes_of(*hulls[1]);
  cache.planes_of(*hulls[2]);
  EXPECT_EQ(cache.planes_of(*hulls[0]), a);
  cache.planes_of(*hulls[3]);
  EXPECT_EQ(cache.size(), 3u);
  EXPECT_EQ(cache.planes_of(*hulls[0]), a);
  EXPECT_NE(cache.planes_of(*hulls[1]), b);
}

TEST(ShapeCache, HasNoPlanesForWhatIsFlat) {
  ShapeCache cache;
  EXPECT_EQ(cache.planes_of(*hull_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})), nullptr);
}

}  // namespace
}  // namespace limber::bullet::test
