#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>

#include "bullet_bridge/shapes/convex_planes.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Bullet's hull computer rounds coordinates to 1/10216 of the extent and finds exact faces of what
// it has rounded. Here faces are put through the corners as they were.
using Loop = std::vector<std::int32_t>;

std::vector<Loop> loops_of(const btConvexHullComputer& hull) {
  std::vector<Loop> loops;
  for (int f = 0; f < hull.faces.size(); ++f) {
    const btConvexHullComputer::Edge* first = &hull.edges[hull.faces[f]];
    const btConvexHullComputer::Edge* edge = first;
    Loop loop;
    do {
      loop.push_back(hull.original_vertex_index[edge->getSourceVertex()]);
      edge = edge->getNextEdgeOfFace();
    } while (edge != first);
    loops.push_back(loop);
  }
  return loops;
}

// Twice the area times the normal of a loop that is nearly flat (Newell's method).
Vec3 area_vector(std::span<const Vec3> points, const Loop& loop) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += (points[loop[i]] - points[loop[0]]).cross(points[loop[i + 1]] - points[loop[0]]);
  }
  return sum;
}

// Through the loop's corners, and no point of the hull outside of it.
HullPlane plane_over(std::span<const Vec3> points, const Vec3& normal) {
  double offset = normal.dot(points[0]);
  for (const Vec3& p : points) offset = std::max(offset, normal.dot(p));
  return {normal, offset};
}

bool is_flat(std::span<const Vec3> points, const Loop& loop, const HullPlane& plane,
             double tolerance) {
  return std::all_of(loop.begin(), loop.end(), [&](std::int32_t c) {
    return plane.offset - plane.normal.dot(points[c]) <= tolerance;
  });
}

// A loop that only the rounding made flat: the triangles of its corners that have none of the
// others outside. There are few corners; each three are tried.
void split(std::span<const Vec3> points, const Loop& loop, const Vec3& outwards, double tolerance,
           std::vector<HullFace>& faces) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        const Loop triangle{loop[i], loop[j], loop[k]};
        const Vec3 area = area_vector(points, triangle);
        if (area.dot(outwards) <= 0.0) continue;
        const Vec3 normal = area.normalized();
        const double offset = normal.dot(points[loop[i]]);
        const bool outermost = std::all_of(loop.begin(), loop.end(), [&](std::int32_t c) {
          return normal.dot(points[c]) - offset <= tolerance;
        });
        if (outermost) faces.push_back({plane_over(points, normal), triangle});
      }
    }
  }
}

}  // namespace

std::vector<HullFace> hull_faces(std::span<const Vec3> points) {
  constexpr double kFlat = 1e-6;          // of the extent: coordinates in single precision
  constexpr std::size_t kMostSplit = 16;  // corners of a loop; beyond, all triples are too many
  if (points.size() < 4) return {};
  btConvexHullComputer hull;
  hull.compute(points[0].data(), sizeof(Vec3), static_cast<int>(points.size()), 0, 0);
  const std::vector<Loop> loops = loops_of(hull);
  if (loops.size() < 4) return {};
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double tolerance = kFlat * (high - low).maxCoeff();
  std::vector<HullFace> faces;
  for (const Loop& loop : loops) {
    const Vec3 area = area_vector(points, loop);
    if (area.norm() <= tolerance * tolerance) continue;
    const HullPlane plane = plane_over(points, area.normalized());
    if (is_flat(points, loop, plane, tolerance) || loop.size() > kMostSplit) {
      faces.push_back({plane, loop});
    } else {
      split(points, loop, area, tolerance, faces);
    }
  }
  return faces;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
