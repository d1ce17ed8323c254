#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bullet_bridge/shapes/contact_part.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A side of a convex polyhedron: normal . x <= offset holds inside.
struct HullPlane {
  Vec3 normal;    // unit, outwards
  double offset;  // m
};

struct HullFace {
  HullPlane plane;
  std::vector<std::int32_t> corners;  // counter-clockwise, seen from outside
};

// A convex polyhedron for many point queries. A grid over it lists, for each cell, the planes that
// may be the nearest one anywhere in the cell: few near the surface, however many there are in all,
// and the answer is that of all planes to the bit.
class ConvexPlanes {
 public:
  // `reach`: how far outside queries are to be as fast as inside, m.
  ConvexPlanes(std::vector<Vec3> corners, const std::vector<HullFace>& faces, double reach);

  // Of the polyhedron and everything within `margin` of it. Exact everywhere: outside the distance
  // to face, edge or corner.
  Penetration penetration(const Vec3& point, double margin) const;

  // Does one of the planes tell at once that the way from a to b stays farther than `margin` away?
  bool parted_from(const Vec3& a, const Vec3& b, double margin) const;

  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }
  std::span<const HullPlane> planes() const { return planes_; }

 private:
  struct Range {
    std::int32_t begin, end;
  };

  void fill(std::array<int, 3> first, int width, std::span<const std::int32_t> planes);
  std::size_t cell_at(int x, int y, int z) const { return (z * cells_ + y) * cells_ + x; }
  std::span<const std::int32_t> planes_near(const Vec3& point) const;
  std::int32_t nearest_plane(const Vec3& point) const;
  Vec3 nearest_on_face(std::int32_t face, const Vec3& point) const;
  Penetration outside(const Vec3& point, double margin, std::int32_t first) const;

  std::vector<Vec3> corners_;
  std::vector<HullPlane> planes_;  // of the faces
  std::vector<Range> loop_;        // of each face, in loop_corners_
  std::vector<std::int32_t> loop_corners_;
  Vec3 low_, high_;  // of the corners, m
  int cells_ = 1;    // along each axis
  Vec3 grid_low_, cell_size_;
  std::vector<Range> cell_;  // in cell_planes_
  std::vector<std::int32_t> cell_planes_;
};

// The polyhedron around points; no faces where they have no volume.
std::vector<HullFace> hull_faces(std::span<const Vec3> points);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
