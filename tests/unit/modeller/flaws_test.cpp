#include "core/modeller/flaws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/model/errors.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

PhysicalModel big_block() {
  PhysicalModel model = test::block({.cells = {10, 10, 10}});
  for (EdgeAttributes& e : model.edges) e.break_threshold = 1.0;
  return model;
}

std::vector<double> thresholds(const Flaws& flaws) {
  PhysicalModel model = big_block();
  add_flaws(model, flaws);
  std::vector<double> values;
  for (const EdgeAttributes& e : model.edges) values.push_back(e.break_threshold);
  return values;
}

// Standard normal numbers of seed 7, computed by another program after the same definition.
TEST(Flaws, AreTheSameOnEveryMachine) {
  const std::vector<double> t = thresholds({.scatter = 0.1, .seed = 7});
  const std::array<double, 4> normal = {-1.2841542452182675, -0.5910228428099922,
                                        -2.0502449457291507, -0.3133384373638832};
  for (std::size_t i = 0; i < normal.size(); ++i) EXPECT_NEAR(t[i], 1.0 + 0.1 * normal[i], 1e-12);
}

TEST(Flaws, DependOnTheSeedAlone) {
  const Flaws one{.scatter = 0.1, .seams = 5, .seam_strength = 0.5, .seed = 1};
  Flaws other = one;
  other.seed = 2;
  EXPECT_EQ(thresholds(one), thresholds(one));
  EXPECT_NE(thresholds(one), thresholds(other));
}

// A normal distribution clipped at 3 sigma has the deviation 0.9973 sigma. With n = 13,000 edges
// the mean is known to 0.0013, the deviation to 0.001.
TEST(Flaws, ScatterHasTheWantedMeanAndDeviation) {
  const std::vector<double> t = thresholds({.scatter = 0.15});
  double sum = 0.0, squares = 0.0;
  for (double x : t) {
    sum += x;
    squares += (x - 1.0) * (x - 1.0);
    EXPECT_LE(std::abs(x - 1.0), 0.45 + 1e-12);
  }
  const double n = static_cast<double>(t.size());
  EXPECT_NEAR(sum / n, 1.0, 0.005);
  EXPECT_NEAR(std::sqrt(squares / n), 0.15, 0.004);
}

TEST(Flaws, SeamsAreExactlyTheEdgesBetweenRegions) {
  PhysicalModel model = big_block();
  add_flaws(model, {.seams = 12, .seam_strength = 0.3, .seed = 5});
  const auto region = voronoi_regions(model.geometry, 12, 5);
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    EXPECT_EQ(model.edges[e].break_threshold, region[a] == region[b] ? 1.0 : 0.3);
  }
}

// A Voronoi region is convex: with two of its points it holds those between them.
TEST(VoronoiRegions, AreAllInhabitedAndConvex) {
  const test::BlockShape shape{.cells = {10, 10, 10}};
  const auto region = voronoi_regions(block_geometry(shape), 12, 5);
  EXPECT_EQ(std::set<std::int32_t>(region.begin(), region.end()).size(), 12u);
  for (int y = 0; y <= 10; ++y) {
    for (int z = 0; z <= 10; ++z) {
      std::set<std::int32_t> left;
      for (int x = 1; x <= 10; ++x) {
        const std::int32_t before = region[test::block_point(shape, {x - 1, y, z})];
        const std::int32_t here = region[test::block_point(shape, {x, y, z})];
        if (here != before) left.insert(before);
        EXPECT_FALSE(left.contains(here));
      }
    }
  }
}

TEST(VoronoiRegions, AreSpreadOverTheModel) {
  const test::BlockShape shape{.cells = {10, 10, 10}};
  const auto region = voronoi_regions(block_geometry(shape), 12, 5);
  std::array<int, 12> size{};
  for (std::int32_t r : region) ++size[static_cast<std::size_t>(r)];
  for (int points : size) {  // 111 on average
    EXPECT_GT(points, 25);
    EXPECT_LT(points, 330);
  }
}

TEST(Flaws, RefuseWhatLeavesNoStrength) {
  PhysicalModel model = big_block();
  EXPECT_THROW(add_flaws(model, {.scatter = 0.4}), InputError);
  EXPECT_THROW(add_flaws(model, {.scatter = NAN}), InputError);
  EXPECT_THROW(add_flaws(model, {.seams = -1}), InputError);
  EXPECT_THROW(add_flaws(model, {.seams = 100000}), InputError);
  EXPECT_THROW(add_flaws(model, {.seams = 3, .seam_strength = 0.0}), InputError);
}

}  // namespace
}  // namespace limber
