#pragma once

#include <ranges>

#include "core/model/vec3.h"

namespace limber {

using Box3 = Eigen::AlignedBox3d;  // m, parallel to the axes

// The smallest box around all points; isEmpty() without points. Takes any range of Vec3.
template <std::ranges::input_range Points>
Box3 bounds_of(const Points& points) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

}  // namespace limber
