#include <algorithm>
#include <cmath>
#include <tuple>

#include "bullet_bridge/shapes/triangle_patch.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

bool before(const Vec3& a, const Vec3& b) {
  return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);
}

// An edge of a triangle; those of other triangles with the same ends are the same edge.
struct Wing {
  Vec3 low, high;  // its ends
  std::int32_t triangle;
  int edge;
  bool upwards;  // the triangle runs from low to high
  double angle;  // of the triangle around the edge, from the first one of the edge
};

bool same_edge(const Wing& a, const Wing& b) { return a.low == b.low && a.high == b.high; }

bool in_order(const Wing& a, const Wing& b) {
  if (a.low != b.low) return before(a.low, b.low);
  if (a.high != b.high) return before(a.high, b.high);
  return a.triangle < b.triangle;
}

std::vector<Wing> wings_of(std::span<const PatchTriangle> triangles) {
  std::vector<Wing> wings;
  wings.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vec3& a = triangles[i].corners[k];
      const Vec3& b = triangles[i].corners[(k + 1) % 3];
      const bool upwards = before(a, b);
      wings.push_back(
          {upwards ? a : b, upwards ? b : a, static_cast<std::int32_t>(i), k, upwards, 0.0});
    }
  }
  std::sort(wings.begin(), wings.end(), in_order);
  return wings;
}

// Right-handed about the edge from low to high.
void measure_angles(std::span<const PatchTriangle> triangles, std::span<Wing> around) {
  const Vec3 axis = (around[0].high - around[0].low).normalized();
  const auto across = [&](const Wing& w) -> Vec3 {
    const Vec3 arm = triangles[w.triangle].corners[(w.edge + 2) % 3] - w.low;
    return arm - axis.dot(arm) * axis;
  };
  const Vec3 x = across(around[0]), y = axis.cross(x);
  for (Wing& w : around.subspan(1)) {
    const Vec3 arm = across(w);
    w.angle = std::atan2(y.dot(arm), x.dot(arm));
    if (w.angle < 0.0) w.angle += 2.0 * M_PI;
  }
}

}  // namespace

// Around an edge the triangles stand like the pages of a book. The front of one that runs upwards
// looks towards larger angles; what it meets there is the next page, from that one's lower side.
void TrianglePatch::find_neighbours() {
  std::vector<Wing> wings = wings_of(triangles_);
  for (std::size_t first = 0, last = 0; first < wings.size(); first = last) {
    while (last < wings.size() && same_edge(wings[first], wings[last])) ++last;
    const std::size_t count = last - first;
    if (count < 2) continue;
    const std::span around(wings.data() + first, count);
    if (count > 2) {
      measure_angles(triangles_, around);
      std::stable_sort(around.begin(), around.end(),
                       [](const Wing& a, const Wing& b) { return a.angle < b.angle; });
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Wing& page = around[i];
      const Wing& next = around[(i + 1) % count];
      triangles_[page.triangle].next[page.upwards][page.edge] = {next.triangle, !next.upwards};
      triangles_[next.triangle].next[!next.upwards][next.edge] = {page.triangle, page.upwards};
    }
  }
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
