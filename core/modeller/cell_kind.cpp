#include "core/modeller/cell_kind.h"

namespace limber {

bool is_sheet_cell(const GeometricModel& geometry, const Cell& cell) {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (FaceId f : cell.faces) {
    const auto& [a, b, c] = geometry.faces[f].corners;
    const Vec3& origin = geometry.points[a];
    const Vec3 area = (geometry.points[b] - origin).cross(geometry.points[c] - origin);
    sum += area;
    total += area.norm();
  }
  return sum.norm() > 0.5 * total;
}

}  // namespace limber
