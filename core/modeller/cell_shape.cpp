#include "core/modeller/cell_shape.h"

#include <algorithm>

namespace limber {

void CellShape::read(const GeometricModel& geometry, const Cell& cell) {
  edges.clear();
  points.clear();
  for (EdgeId e : cell.edges) {
    const auto [a, b] = geometry.edges[e];
    edges.push_back(geometry.points[b] - geometry.points[a]);
    points.push_back(a);
    points.push_back(b);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

}  // namespace limber
