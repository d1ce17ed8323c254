#pragma once

#include <array>

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

using Corners = std::array<Vec3, 3>;  // edge k runs from corner k to the next

struct TriangleFoot {
  Vec3 point;          // of the triangle, nearest to what was asked for
  unsigned edges = 0;  // bit k: it lies on edge k
};

// By Voronoi regions (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
TriangleFoot foot_on_triangle(const Corners& triangle, const Vec3& point);

// Does the line through a and b pass the triangle? Edges count, and a hair beside them does, so
// that nothing slips between two triangles that share one.
bool line_passes(const Corners& triangle, const Vec3& a, const Vec3& b);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
