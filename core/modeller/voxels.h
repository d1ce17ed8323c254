#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/modeller/triangle_mesh.h"
#include "core/modeller/winding_number.h"

namespace limber {

using VoxelIndex = std::array<std::int32_t, 3>;  // of a cell in its grid

// Cubes of `spacing`, x fastest.
struct VoxelGrid {
  Vec3 origin = Vec3::Zero();    // m, the lowest corner
  double spacing = 0.0;          // m
  VoxelIndex cells = {0, 0, 0};  // along each axis

  std::size_t size() const {
    return std::size_t(cells[0]) * std::size_t(cells[1]) * std::size_t(cells[2]);
  }
  bool contains(const VoxelIndex& p) const;
  std::size_t index(const VoxelIndex& p) const {
    return std::size_t(p[0]) + std::size_t(cells[0]) * (p[1] + std::size_t(cells[1]) * p[2]);
  }
  VoxelIndex place(std::size_t index) const;
  Vec3 lowest_corner(const VoxelIndex& p) const;  // m
  VoxelIndex around(const Vec3& x) const;         // of the cell that x is in; of the nearest one
};

// The grid in the middle of the mesh's box, of the whole number of cells nearest to its length
// along each axis, at least one: a box of whole cells is met exactly, another as well as cells can.
// One more on every side, never half full, is for what sticks out of these by up to a quarter of a
// cell: it counts in moments.
VoxelGrid grid_around(const TriangleMesh& mesh, double spacing_m);

// How much of each cell is inside the mesh.
struct VoxelShares {
  std::vector<float> share;           // shape (cells): 0..1, where the winding number is above 1/2
  std::vector<std::int32_t> surface;  // the cells that the mesh passes through, and few others
  std::size_t ambiguous = 0;          // cells whose middle has a winding number near 1/2
  // The share of all directions that lead out through holes, mean over what is inside: a closed
  // mesh has a winding number of 1 there, or another whole number.
  double openness = 0.0;
  double highest = 0.0;  // winding number met: 2 where parts overlap
  SolidMoments moments;  // of the samples' part inside
};

// Cells that the surface passes through are sampled at 3 x 3 x 3 places, the others in the middle.
// `fine` is the same surface in triangles that are small against the cells. `closed`: between
// surface cells the winding number does not change, which saves asking.
VoxelShares voxel_shares(const VoxelGrid& grid, const TriangleMesh& fine,
                         const FastWindingNumber& winding, bool closed);

}  // namespace limber
