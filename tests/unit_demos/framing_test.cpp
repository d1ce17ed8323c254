#include "demos/scenes/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limber::demos {
namespace {

// Tangent of the angle between the way the camera looks and the point, over that of half the field
// of view: 1 at the height of the picture's rim.
double reach(const Camera& camera, const Vec3& point) {
  const Vec3 ahead = (camera.target - camera.position).normalized();
  const Vec3 ray = point - camera.position;
  const double along = ahead.dot(ray);
  return (ray - along * ahead).norm() / along /
         std::tan(camera.field_of_view_deg * std::numbers::pi / 360.0);
}

double farthest_corner(const Camera& camera, const Box3& box) {
  double most = 0.0;
  for (int i = 0; i < 8; ++i)
    most = std::max(most, reach(camera, box.corner(static_cast<Box3::CornerType>(i))));
  return most;
}

TEST(Framed, FillsThePictureWithTheBoxWhereverItIs) {
  const Camera camera{{1, 1, 3}, {0, 0.5, 0}, 30.0};
  for (const Box3& box :
       {Box3(Vec3(0, 0, 0), Vec3(1, 1, 1)), Box3(Vec3(5, 2, -7), Vec3(5.1, 2.3, -6.9)),
        Box3(Vec3(-20, 0, -1), Vec3(20, 3, 1))}) {
    const Camera moved = framed(camera, box, 1.0);
    EXPECT_LE(farthest_corner(moved, box), 1.0);
    EXPECT_GT(farthest_corner(moved, box), 0.7);
    const Vec3 was = camera.target - camera.position, is = moved.target - moved.position;
    EXPECT_LT(was.normalized().cross(is.normalized()).norm(), 1e-12);  // looks the same way
  }
}

TEST(Framed, ZoomComesNearer) {
  const Camera camera{{0, 0, 3}, {0, 0, 0}, 30.0};
  const Box3 box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  EXPECT_NEAR(framed(camera, box, 1.0).position.z(), 2.0 * framed(camera, box, 2.0).position.z(),
              1e-12);
  EXPECT_GT(framed(camera, Box3(Vec3::Zero(), Vec3::Zero()), 1.0).position.norm(), 0.01);
}

TEST(BoxOfMost, LeavesOutAFewFarOnes) {
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i) points.push_back({0.001 * i, 1.0, -0.002 * i});
  points.push_back({50, -3, 0});
  points.push_back({0, 0, 90});
  const Box3 box = box_of_most(points);
  EXPECT_NEAR(box.min().x(), 0.02, 0.002);
  EXPECT_NEAR(box.max().x(), 0.98, 0.002);
  EXPECT_NEAR(box.max().z(), -0.04, 0.004);
  EXPECT_EQ(box.sizes().y(), 0.0);
  EXPECT_TRUE(box_of_most({}).isEmpty());
  EXPECT_EQ(box_of_most({Vec3(1, 2, 3)}).min(), Vec3(1, 2, 3));
}

}  // namespace
}  // namespace limber::demos
