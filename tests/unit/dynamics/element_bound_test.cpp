#include "core/dynamics/element_bound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/dynamics/stable_step.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

// Two points, no cell: the bond is the only element.
TEST(ElementBound, OfADumbbellIsExact) {
  GeometricModelBuilder builder;
  builder.begin_subobject("dumbbell");
  builder.edge(builder.add_point(Vec3::Zero()), builder.add_point(Vec3::UnitX()));
  PhysicalModel model = with_default_attributes(builder.finish(), "dumbbell");
  model.points[PointId(std::size_t{0})].mass = 2.0;
  model.points[PointId(std::size_t{1})].mass = 3.0;
  model.edges[EdgeId(std::size_t{0})].stiffness = 60.0;
  EXPECT_NEAR(element_frequency_bound(model), std::sqrt(60.0 / 2.0 + 60.0 / 3.0), 1e-7);
}

// One element: its own eigenvalue, which the factorisation meets within a few per cent.
TEST(ElementBound, OfOneCellIsExact) {
  const PhysicalModel model = test::block({});
  const double proved = highest_frequency(model).omega_max;
  EXPECT_LE(element_frequency_bound(model), proved * (1.0 + 1e-6));
  EXPECT_GE(element_frequency_bound(model), proved / 1.06);
}

TEST(ElementBound, OfABlockIsNotBelowTheProvedFrequencyLessItsMargin) {
  const PhysicalModel model = test::block({.cells = {4, 3, 2}});
  EXPECT_GE(element_frequency_bound(model), highest_frequency(model).omega_max / 1.06);
}

TEST(ElementBound, OfNothingButBrokenEdgesIsZero) {
  PhysicalModel model = test::block({});
  for (EdgeAttributes& e : model.edges) e.broken = true;
  EXPECT_EQ(element_frequency_bound(model), 0.0);
}

}  // namespace
}  // namespace limber
