#include "core/dynamics/block_bound.h"

#include <gtest/gtest.h>

#include <array>

#include "core/dynamics/stable_step.h"
#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"

namespace limber {
namespace {

PhysicalModel block(std::array<int, 3> cells, const Vec3& spacing = Vec3::Constant(0.1)) {
  Material rubber;
  rubber.density = 1000.0;
  rubber.youngs_modulus = 1e6;
  return with_material(box_lattice(cells, spacing, Vec3::Zero(), "block"), "block", rubber);
}

// Against the frequency that a factorisation of the whole proves, which is itself up to 0.5 % high.
void expect_close_above(const PhysicalModel& model, double share) {
  const FrequencyBound whole = highest_frequency(model);
  ASSERT_TRUE(whole.verified);
  const auto by_blocks = block_frequency_bound(model);
  ASSERT_TRUE(by_blocks);
  EXPECT_GE(*by_blocks, whole.omega_max / 1.005);
  EXPECT_LE(*by_blocks, whole.omega_max * share);
}

TEST(BlockBound, OfBoxesIsWithinOnePerCent) {
  for (int cells : {3, 5, 7, 8, 10, 12}) expect_close_above(block({cells, cells, cells}), 1.01);
  expect_close_above(block({20, 5, 3}), 1.01);
  expect_close_above(block({9, 8, 7}, {0.1, 0.12, 0.15}), 1.01);
}

TEST(BlockBound, OfATurnedAndMovedBoxIsTheSame) {
  const PhysicalModel at_home = block({10, 10, 10});
  PhysicalModel away = at_home;
  place(away, Mat3(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized())), {10.0, -3.0, 2.0});
  EXPECT_NEAR(*block_frequency_bound(away) / *block_frequency_bound(at_home), 1.0, 1e-6);
}

TEST(BlockBound, HoldsWithWeakAndBrokenAndHeavyParts) {
  PhysicalModel model = block({8, 8, 8});
  for (EdgeId e : ids_of(model.edges)) {
    if (e.value % 11 == 0) model.edges[e].broken = true;
  }
  for (PointId p : ids_of(model.points)) {
    if (model.geometry.points[p].x() < 0.35) model.points[p].mass *= 50.0;
  }
  expect_close_above(model, 1.2);
}

// Some springs under tension stiffen across themselves.
TEST(BlockBound, HoldsForAStretchedBox) {
  PhysicalModel model = block({8, 6, 6});
  for (Vec3& p : model.geometry.points) p.x() *= 1.2;
  expect_close_above(model, 1.02);
}

TEST(BlockBound, NeedsAGrid) {
  PhysicalModel bent = block({6, 6, 6});
  for (Vec3& p : bent.geometry.points) {
    p = {5.0 * p.x() * p.x(), p.y() + p.x(), 4.0 * p.z() * p.z()};
  }
  EXPECT_FALSE(block_frequency_bound(bent));
}

// What a factorisation of the whole is too large for gets nine tenths of its largest step all the
// same.
TEST(BlockBound, GivesLargeBoxesTheStepOfSmallOnes) {
  const FrequencyBound small = highest_frequency(block({12, 12, 12}));
  const FrequencyBound large = highest_frequency(block({17, 17, 17}));
  ASSERT_TRUE(small.verified);
  ASSERT_FALSE(large.verified);
  EXPECT_NEAR(large.omega_max / small.omega_max, 1.0, 0.01);
}

}  // namespace
}  // namespace limber
