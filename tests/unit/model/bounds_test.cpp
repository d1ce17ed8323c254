#include "core/model/bounds.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/model/ids.h"

namespace limber {
namespace {

TEST(Bounds, AreEmptyWithoutPoints) { EXPECT_TRUE(bounds_of(std::vector<Vec3>{}).isEmpty()); }

TEST(Bounds, OfOnePointAreThePoint) {
  const Box3 box = bounds_of(std::vector<Vec3>{{-1.0, 2.0, 3.0}});
  EXPECT_EQ(box.min(), Vec3(-1.0, 2.0, 3.0));
  EXPECT_EQ(box.max(), Vec3(-1.0, 2.0, 3.0));
}

TEST(Bounds, TakeEachAxisFromAnotherPoint) {
  IdVector<PointId, Vec3> points;
  points.push_back({-1.0, 5.0, 0.0});
  points.push_back({4.0, -2.0, -1e-300});
  points.push_back({0.0, 0.0, 7.0});
  const Box3 box = bounds_of(points);
  EXPECT_EQ(box.min(), Vec3(-1.0, -2.0, -1e-300));
  EXPECT_EQ(box.max(), Vec3(4.0, 5.0, 7.0));
}

}  // namespace
}  // namespace limber
