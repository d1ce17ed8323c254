#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bullet_bridge/shapes/contact_part.h"
#include "core/contact/triangle.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A side of a triangle of a patch.
struct TriangleSide {
  std::int32_t triangle = -1;
  bool front = true;  // where the corners are seen counter-clockwise
};

struct PatchTriangle {
  std::int64_t key;  // of the triangle in its shape, the same in every tick
  Triangle corners;
  Vec3 normal = Vec3::Zero();  // unit, to the front
  // Seen from the back [0] or the front [1]: what follows beyond each edge. -1: a border.
  std::array<std::array<TriangleSide, 3>, 2> next{};

  // To its front, m.
  double height_of(const Vec3& point) const { return normal.dot(point - corners[0]); }
};

// Triangles of a mesh or height field around a lattice, gathered for a tick. They are two-sided and
// may be any soup; triangles with an edge in common know each other.
class TrianglePatch {
 public:
  struct Raw {
    std::int64_t key;
    Triangle corners;
  };

  // Queries within `margin` of a triangle will find it, m. Triangles without area are left out.
  TrianglePatch(std::vector<Raw> raw, double margin);

  // The first triangle that the way from a to b passes, seen from the side where a lies (a point of
  // the triangle itself counts as being on its front).
  struct Passing {
    TriangleSide side;
    double share = 2.0;  // of the way; > 1: none
    bool again = false;  // it passes another one later
  };
  Passing first_passed(const Vec3& a, const Vec3& b) const;

  // Does a triangle part two points? Those that one of the points lies on do not.
  bool parted(const Vec3& a, const Vec3& b) const;

  // The nearest point of a surface. `behind`: the point that asked is not on the side it was seen
  // from.
  struct Nearest {
    TriangleSide side;  // triangle -1: none
    Vec3 foot = Vec3::Zero();
    double distance = 0.0;  // m
    bool behind = false;
    bool on_border = false;  // nearest_around() only
  };

  // Of the triangles near the point (within the margin, at least), or of all of them, seen from the
  // side on which the point is.
  Nearest nearest_near(const Vec3& point) const;
  Nearest nearest_of_all(const Vec3& point) const;

  // Of everything within `margin` of a triangle: looks at all of them.
  Penetration penetration(const Vec3& point, double margin) const;

  // Of the surface around `from`: goes on to triangles that face within 60 degrees of `normal` (the
  // side the point came from) as long as they are nearer, and over any edge on which the foot lies.
  // So a point under one side of a fold does not change over to the other, unless it slides there.
  Nearest nearest_around(TriangleSide from, const Vec3& point, const Vec3& normal) const;

  // Where another triangle takes over at a border: it faces within 60 degrees of `normal`, and the
  // point lies behind it, about as deep as behind the last one. For meshes whose triangles touch
  // without common edges.
  TriangleSide taking_over(const Nearest& last, const Vec3& point, const Vec3& normal) const;

  Vec3 facing(TriangleSide side) const {
    const Vec3& normal = triangles_[side.triangle].normal;
    return side.front ? normal : Vec3(-normal);
  }
  std::int32_t index_of(std::int64_t key) const;  // -1: not here

  std::span<const PatchTriangle> triangles() const { return triangles_; }
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }

 private:
  struct Range {
    std::int32_t begin, end;
  };
  using Cell = std::array<int, 3>;

  void find_neighbours();
  void make_grid(double margin);
  Cell cell_of(const Vec3& point) const;
  std::size_t cell_index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * cells_[1] + y) * cells_[0] + x;
  }
  bool touches_cell(const PatchTriangle& triangle, const Cell& cell, double margin) const;
  template <class Visit>
  void for_each_cell_of(const PatchTriangle& triangle, double margin, Visit visit) const;
  template <class Visit>
  void for_each_near(const Vec3& low, const Vec3& high, Visit visit) const;
  Nearest seen_from(TriangleSide side, const Vec3& point, const NearestPoint& at) const;
  Nearest seen_from_its_side(const Vec3& point, std::int32_t triangle,
                             const NearestPoint& at) const;

  std::vector<PatchTriangle> triangles_;  // ascending by key
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
  Cell cells_{1, 1, 1};
  Vec3 cell_size_ = Vec3::Ones();
  Vec3 cells_per_m_ = Vec3::Ones();
  std::vector<Range> cell_;  // in cell_triangles_
  std::vector<std::int32_t> cell_triangles_;
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
