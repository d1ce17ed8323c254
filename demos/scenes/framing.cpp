#include "demos/scenes/framing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limber::demos {
namespace {

constexpr double kOutermost = 0.02;    // share of the points, to each side
constexpr double kLeastRadius = 0.02;  // m

}  // namespace

Camera framed(const Camera& camera, const Box3& box, double zoom) {
  const double radius = std::max(0.5 * box.sizes().norm(), kLeastRadius);
  const double half_angle = camera.field_of_view_deg * std::numbers::pi / 360.0;
  const Vec3 back = (camera.position - camera.target).normalized();
  Camera moved = camera;
  moved.target = box.center();
  moved.position = box.center() + radius / std::sin(half_angle) / zoom * back;
  return moved;
}

Box3 box_of_most(std::vector<Vec3> points) {
  Box3 box;
  if (points.empty()) return box;
  const auto left_out =
      static_cast<std::ptrdiff_t>(kOutermost * static_cast<double>(points.size()));
  Vec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const auto before = [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; };
    std::nth_element(points.begin(), points.begin() + left_out, points.end(), before);
    low[axis] = points[static_cast<std::size_t>(left_out)][axis];
    std::nth_element(points.begin(), points.end() - 1 - left_out, points.end(), before);
    high[axis] = (points.end() - 1 - left_out)->operator[](axis);
  }
  return Box3(low, high);
}

}  // namespace limber::demos
