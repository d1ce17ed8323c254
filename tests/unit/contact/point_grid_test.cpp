#include "core/contact/point_grid.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/support/lattices.h"

namespace limber {
namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

Pair ordered(std::int32_t i, std::int32_t j) { return {std::min(i, j), std::max(i, j)}; }

// Pairs nearer than the cell; fails the test when the grid names one twice or pairs a point with
// itself.
std::set<Pair> by_grid(const std::vector<Vec3>& points, double cell) {
  std::set<Pair> visited, near;
  PointGrid(points, cell).for_each_near_pair([&](std::int32_t i, std::int32_t j) {
    EXPECT_NE(i, j);
    EXPECT_TRUE(visited.insert(ordered(i, j)).second) << i << ", " << j << " named twice";
    if ((points[i] - points[j]).norm() < cell) near.insert(ordered(i, j));
  });
  return near;
}

std::set<Pair> by_looking_at_all(const std::vector<Vec3>& points, double cell) {
  std::set<Pair> near;
  const auto n = static_cast<std::int32_t>(points.size());
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t j = i + 1; j < n; ++j) {
      if ((points[i] - points[j]).norm() < cell) near.insert({i, j});
    }
  }
  return near;
}

TEST(PointGrid, FindsTheNearPairsOfRandomPoints) {
  std::mt19937 random(21);
  for (double cell : {0.1, 0.3, 1.0, 5.0}) {
    std::vector<Vec3> points;
    for (int i = 0; i < 300; ++i) points.push_back(test::random_vector(random, 1.0));
    const std::set<Pair> wanted = by_looking_at_all(points, cell);
    EXPECT_FALSE(wanted.empty());
    EXPECT_EQ(by_grid(points, cell), wanted);
  }
}

// Integer coordinates lie on the borders of the cells, on either side of zero.
TEST(PointGrid, FindsTheNearPairsOfALatticeOnItsBorders) {
  std::vector<Vec3> points;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) points.push_back(Vec3(x, y, z));
  EXPECT_EQ(by_grid(points, 1.0), by_looking_at_all(points, 1.0));
  EXPECT_EQ(by_grid(points, 1.5), by_looking_at_all(points, 1.5));
}

TEST(PointGrid, PairsCoincidentPoints) {
  EXPECT_EQ(by_grid({Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(9, 9, 9)}, 0.1), std::set<Pair>({{0, 1}}));
}

// Every point of the box, some around it, none twice.
TEST(PointGrid, FindsThePointsAroundABox) {
  std::mt19937 random(22);
  constexpr double kCell = 0.3;
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i) points.push_back(test::random_vector(random, 1.0));
  const PointGrid grid(points, kCell);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 a = test::random_vector(random, 1.0), b = test::random_vector(random, 1.0);
    const Vec3 low = a.cwiseMin(b), high = a.cwiseMax(b);
    std::multiset<std::int32_t> found;
    grid.for_each_around(low, high, [&](std::int32_t i) { found.insert(i); });
    for (std::int32_t i = 0; i < 300; ++i) {
      const Vec3& x = points[static_cast<std::size_t>(i)];
      const auto within = [&](double by) {
        return ((x - low).array() >= -by).all() && ((high - x).array() >= -by).all();
      };
      EXPECT_LE(found.count(i), 1u);
      if (within(0.0)) {
        EXPECT_EQ(found.count(i), 1u);
      }
      if (!within(kCell)) {
        EXPECT_EQ(found.count(i), 0u);
      }
    }
  }
}

TEST(PointGrid, OfNoPointsHasNoPairs) { EXPECT_TRUE(by_grid({}, 1.0).empty()); }

}  // namespace
}  // namespace limber
