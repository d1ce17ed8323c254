#include "core/operators/point_pairs.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/gluing_cases.h"

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

// In doubles 1.1 - 1.0 is 0.10000000000000009. A micrometre less, on a length of a metre, is 450
// times what rounding is allowed: 10^6 um apart, but sqrt(10^12 + 1) um is too far.
TEST(PairsWithin, RoundingDoesNotDecide) {
  const PointPositions a = positions({{1.0, 0, 0}});
  const PointPositions beside = positions({{1.1, 0, 0}});
  ASSERT_GT((beside[PointId(0)] - a[PointId(0)]).norm(), 0.1);
  EXPECT_EQ(pairs_within(a, beside, 0.1).size(), 1u);
  EXPECT_EQ(pairs_within(a, positions({{2.0, 0, 0}}), 1.0).size(), 1u);
  EXPECT_EQ(pairs_within(a, positions({{2.0, 1e-6, 0}}), 1.0).size(), 0u);
}

TEST(PairsWithin, DistanceZeroFindsCoincidentPoints) {
  const PointPositions a = positions({{0.1 + 0.2, 0, 0}, {1, 0, 0}, {0, 0, 0}});
  const PointPositions b = positions({{0.3, 0, 0}, {1, 1e-6, 0}, {0, 0, 0}});
  const std::vector<PointPair> pairs = pairs_within(a, b, 0.0);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].b, PointId(0));
  EXPECT_EQ(pairs[1].b, PointId(2));
}

// Points 0.1 m apart on a long row whose grid cubes begin elsewhere: every one has its partner.
TEST(PairsWithin, FindsNeighboursExactlyOneCubeAway) {
  PointPositions a, b;
  for (int i = 0; i < 20000; ++i) {
    a.push_back(Vec3(0.1 * i + 0.05, 0, 0));
    b.push_back(Vec3(0.1 * (i + 1) + 0.05, 0, 0));
  }
  // 0.1 (i - j - 1) m apart: two for each but the ends, and the same place for all but one.
  EXPECT_EQ(pairs_within(a, b, 0.1).size(), 20000u + 19999u + 19998u);
}

PointPositions grid(std::array<int, 3> n, double spacing, const Vec3& origin) {
  PointPositions points;
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) points.push_back(origin + spacing * Vec3(x, y, z));
  return points;
}

// Nothing to pair, and grids with a layer in common: what cannot be glued.
const test::GluingCase kDegenerateCases[] = {
    {{3, 3, 3}, 0.1, {3, 3, 3}, 0.1, {0.3, 0, 0}, 0.099999, 0, 0, 0, 0, 0},
    {{3, 3, 3}, 0.1, {3, 3, 3}, 0.1, {0.2, 0, 0}, 0.0, 9, 0, 9, 9, 9},
    {{3, 3, 3}, 0.1, {3, 3, 3}, 0.1, {0.2, 0, 0}, 0.1, 51, 9, 18, 18, 9},
    {{3, 3, 3}, 0.1, {3, 3, 3}, 0.1, {0.2, 0, 0}, 0.142, 115, 115, 18, 18, 9},
};

void expect_counts(const test::GluingCase& c) {
  const PointPositions a = grid(c.points_a, c.spacing_a, Vec3::Zero());
  const PointPositions b = grid(c.points_b, c.spacing_b, c.origin_b);
  const std::vector<PointPair> pairs = pairs_within(a, b, c.distance);
  std::set<PointId> partners_a, partners_b;
  std::size_t less = 0;
  for (const PointPair& pair : pairs) {
    partners_a.insert(pair.a);
    partners_b.insert(pair.b);
    less += pair.distance < c.distance - pair.rounding;
  }
  EXPECT_EQ(pairs.size(), c.at_most) << c.distance;
  EXPECT_EQ(less, c.less) << c.distance;
  EXPECT_EQ(partners_a.size(), c.with_partner_a) << c.distance;
  EXPECT_EQ(partners_b.size(), c.with_partner_b) << c.distance;
  EXPECT_EQ(one_to_one(pairs).size(), c.one_to_one) << c.distance;
}

TEST(PairsWithin, AgreeWithTheReferenceCounts) {
  for (const test::GluingCase& c : test::kGluingCases) expect_counts(c);
  for (const test::GluingCase& c : kDegenerateCases) expect_counts(c);
}

TEST(OneToOne, TakesTheNearestFirstAndEveryPointOnce) {
  const std::vector<PointPair> pairs = {{PointId(0), PointId(0), 0.5, 0.0},
                                        {PointId(0), PointId(1), 0.2, 0.0},
                                        {PointId(1), PointId(1), 0.3, 0.0},
                                        {PointId(2), PointId(0), 0.6, 0.0}};
  const std::vector<PointPair> chosen = one_to_one(pairs);
  ASSERT_EQ(chosen.size(), 2u);
  EXPECT_EQ(chosen[0].distance, 0.2);
  EXPECT_EQ(chosen[1].distance, 0.6);
}

// The second is nearer by less than rounding: ids decide, as they would on paper.
TEST(OneToOne, TakesTheSmallestIdsAmongEquals) {
  const std::vector<PointPair> chosen = one_to_one(
      {{PointId(1), PointId(0), 0.1, 1e-15}, {PointId(0), PointId(0), 0.1 + 1e-16, 1e-15}});
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].a, PointId(0));
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
