#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/dynamics/lattice.h"
#include "core/operators/boundary_tracker.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A face of a lattice's boundary.
struct SurfaceFace {
  std::int32_t face;
  std::array<std::int32_t, 3> corners;
  bool sheet;  // has two sides
};

// The boundary of what is flexible: all faces with dynamic corners, and which way it looks at each
// point. To be made anew after breaks and whenever other points are dynamic; until then faces that
// have left the boundary do not count.
class LatticeSurface {
 public:
  LatticeSurface() = default;
  LatticeSurface(const Lattice& lattice, const BoundaryTracker& boundary);

  // Is it of this boundary, as that is now?
  bool is_of(const BoundaryTracker& boundary) const {
    return boundary_ == &boundary && revision_ == boundary.revision();
  }

  std::span<const SurfaceFace> faces() const { return faces_; }  // ascending
  bool has(std::int32_t face) const { return boundary_->contains(face); }

  // Twice the area vectors of the faces around a point, summed, m^2: outwards where they belong to
  // cells. Zero for points of ropes, within solids, and of bodies folded flat.
  Vec3 outwards_at(const Lattice& lattice, std::int32_t point) const;
  bool is_of_sheet(std::int32_t point) const { return of_sheet_[point]; }

 private:
  const BoundaryTracker* boundary_ = nullptr;
  std::uint64_t revision_ = 0;
  std::vector<SurfaceFace> faces_;
  std::vector<std::int32_t> first_;     // shape (P + 1): of the point's share in around_
  std::vector<std::int32_t> around_;    // indices of faces_
  std::vector<std::uint8_t> of_sheet_;  // shape (P)
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
