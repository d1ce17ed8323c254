#include "core/dynamics/may_fold.h"

#include <gtest/gtest.h>

#include "core/modeller/cubic_lattice.h"
#include "core/operators/gluing_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

// That nothing is taken for rigid that has a mechanism is a property test
// (automatic_step_property_test.cpp); here: what does not fold is known as such.

namespace limber {
namespace {

bool folds(std::array<int, 3> points, const CubicSprings& springs) {
  return may_fold(cubic_lattice({.points = points, .springs = springs}));
}

TEST(MayFold, RopesSheetsAndCubesWithoutDiagonals) {
  EXPECT_TRUE(may_fold(test::chain({.points = 5})));
  EXPECT_TRUE(folds({4, 4, 1}, {1.0, 1.0, 0.0}));
  EXPECT_TRUE(folds({3, 3, 3}, {1.0, 0.0, 0.0}));
  EXPECT_TRUE(folds({3, 3, 3}, {1.0, 0.0, 1.0}));
  EXPECT_TRUE(folds({3, 3, 3}, {1.0, 1e-4, 0.0}));
}

TEST(MayFold, NotBracedBlocksHoweverSlender) {
  EXPECT_FALSE(folds({3, 3, 3}, {1.0, 1.0, 0.0}));
  EXPECT_FALSE(folds({3, 3, 3}, {1.0, 0.1, 0.0}));
  EXPECT_FALSE(folds({20, 2, 2}, {1.0, 1.0, 1.0}));
  EXPECT_FALSE(folds({9, 9, 2}, {1.0, 1.0, 0.0}));
}

// Springs that are broken brace nothing.
TEST(MayFold, CubesWhoseDiagonalsBroke) {
  PhysicalModel cube = cubic_lattice({.springs = {1.0, 1.0, 0.0}});
  for (EdgeAttributes& e : cube.edges) e.broken = e.rest_length > 1.1;
  EXPECT_TRUE(may_fold(cube));
}

// Two cubes side by side, with a bond for every two points that near.
PhysicalModel glued(double distance) {
  const PhysicalModel left = test::block({.spacing = 1.0, .name = "left"});
  const PhysicalModel right =
      test::block({.spacing = 1.0, .origin = {1.2, 0.0, 0.0}, .name = "right"});
  return glue(left, right, {.distance = distance, .stiffness = 100.0}).model;
}

// Four parallel bonds leave shear and twist; those to the neighbours as well leave nothing.
TEST(MayFold, WhatTooFewBondsHold) {
  EXPECT_TRUE(may_fold(glued(0.3)));
  EXPECT_FALSE(may_fold(glued(1.6)));
}

}  // namespace
}  // namespace limber
