#include "core/operators/point_pairs.h"

#include <gtest/gtest.h>

namespace limber {
namespace {

PointPositions positions(std::initializer_list<Vec3> list) {
  PointPositions points;
  for (const Vec3& x : list) points.push_back(x);
  return points;
}

TEST(PairsWithin, AreOrderedAndIncludeTheDistanceItself) {
  const PointPositions a = positions({{0, 0, 0}, {-1, 0, 0}});
  const PointPositions b = positions({{0, 2, 0}, {-1, 0, 0.5}, {0, 0, -1}});
  const std::vector<PointPair> pairs = pairs_within(a, b, 1.0);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].a, PointId(0));
  EXPECT_EQ(pairs[0].b, PointId(2));
  EXPECT_EQ(pairs[0].distance, 1.0);
  EXPECT_EQ(pairs[1].a, PointId(1));
  EXPECT_EQ(pairs[1].b, PointId(1));
}

TEST(PairsWithin, NoPointsNoPairs) {
  const PointPositions one = positions({{0, 0, 0}});
  EXPECT_TRUE(pairs_within({}, one, 1.0).empty());
  EXPECT_TRUE(pairs_within(one, {}, 1.0).empty());
  EXPECT_TRUE(pairs_within({}, {}, 1.0).empty());
}

// A distance far below the extent would give more grid cubes than an integer counts.
TEST(PairsWithin, TinyDistanceInAHugeScene) {
  const PointPositions a = positions({{1e6, 0, 0}, {-1e6, 5, 5}});
  const PointPositions b = positions({{1e6, 1e-7, 0}, {-1e6, 5, 6}, {0, 1e6, -1e6}});
  const std::vector<PointPair> pairs = pairs_within(a, b, 1e-6);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].b, PointId(0));
}

TEST(PairsWithin, PointsFarFromTheGridAreNoNeighbours) {
  const PointPositions a = positions({{1e300, 0, 0}, {0.5, 0, 0}});
  const PointPositions b = positions({{0, 0, 0}});
  const std::vector<PointPair> pairs = pairs_within(a, b, 1.0);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].a, PointId(1));
}

TEST(NearestPair, PrefersTheSmallestIdsAmongEquals) {
  const PointPositions a = positions({{0, 0, 0}, {0, 3, 0}});
  const PointPositions b = positions({{9, 9, 9}, {2, 3, 0}, {2, 0, 0}});
  const PointPair pair = nearest_pair(a, b);
  EXPECT_EQ(pair.a, PointId(0));
  EXPECT_EQ(pair.b, PointId(2));
  EXPECT_EQ(pair.distance, 2.0);
}

// Both points of b are 5 m away; the sweep along x meets the one with the larger id first, and the
// other when x alone is already 5 m.
TEST(NearestPair, LooksAtPointsExactlyAsFarAsTheBest) {
  const PointPair pair = nearest_pair(positions({{0, 0, 0}}), positions({{5, 0, 0}, {3, 4, 0}}));
  EXPECT_EQ(pair.b, PointId(0));
  EXPECT_EQ(pair.distance, 5.0);
}

}  // namespace
}  // namespace limber
