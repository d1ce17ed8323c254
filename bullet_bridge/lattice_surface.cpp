#include "bullet_bridge/lattice_surface.h"

#include <algorithm>
#include <numeric>

#include "core/contact/triangle.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
LatticeSurface::LatticeSurface(const Lattice& lattice, const BoundaryTracker& boundary)
    : boundary_(&boundary),
      revision_(boundary.revision()),
      first_(lattice.motion.size() + 1, 0),
      of_sheet_(lattice.motion.size(), 0) {
  for (std::int32_t f : boundary.faces()) {
    const std::array<std::int32_t, 3>& corners = lattice.face_corners[f];
    const bool dynamic = std::all_of(corners.begin(), corners.end(), [&](std::int32_t p) {
      return lattice.role[p] == PointRole::kDynamic;
    });
    if (dynamic) faces_.push_back({f, corners, lattice.face_two_sided[f] != 0});
  }
  std::sort(faces_.begin(), faces_.end(),
            [](const SurfaceFace& a, const SurfaceFace& b) { return a.face < b.face; });
  for (const SurfaceFace& face : faces_) {
    for (std::int32_t p : face.corners) {
      ++first_[p + 1];
      of_sheet_[p] = of_sheet_[p] || face.sheet;
    }
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  around_.resize(3 * faces_.size());
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    for (std::int32_t p : faces_[i].corners) around_[next[p]++] = static_cast<std::int32_t>(i);
  }
}

Vec3 LatticeSurface::outwards_at(const Lattice& lattice, std::int32_t point) const {
  Vec3 sum = Vec3::Zero();
  for (std::int32_t i = first_[point]; i < first_[point + 1]; ++i) {
    const SurfaceFace& face = faces_[around_[i]];
    if (!has(face.face)) continue;
    const auto& [a, b, c] = face.corners;
    sum += twice_area_vector(
        {lattice.motion[a].position, lattice.motion[b].position, lattice.motion[c].position});
  }
  return sum;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
