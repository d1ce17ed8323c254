#pragma once

#include <cstdint>
#include <vector>

#include "core/modeller/voxels.h"

namespace limber {

// How the kept cells of a grid hang together.
struct VoxelPieces {
  std::size_t by_faces = 0;   // pieces of cells joined by faces
  std::size_t by_points = 0;  // pieces of cells joined by points at least
  std::size_t loose = 0;      // cells outside the largest by_faces piece of their by_points piece
};

// `cells`: indices into the grid, ascending.
VoxelPieces voxel_pieces(const VoxelGrid& grid, const std::vector<std::int32_t>& cells);

// The cells but for specks: pieces without a point in common with the rest, of less than 8 cells
// and less than 1 % of all.
std::vector<std::int32_t> without_specks(const VoxelGrid& grid,
                                         const std::vector<std::int32_t>& cells);

}  // namespace limber
