#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/modeller/hexahedral_cell.h"
#include "core/modeller/voxels.h"

namespace limber {

// A cell of the lattice in the grid it was made from.
struct LatticeCell {
  VoxelIndex place = {0, 0, 0};
  CellId cell;
  HexahedronCorners corners;
};

struct VoxelLattice {
  GeometricModel geometry;  // one subobject
  std::vector<LatticeCell> cells;
};

// One hexahedron for each of these cells of the grid, which neighbours share their corners with.
// `kept`: indices into the grid, ascending.
VoxelLattice voxel_lattice(const VoxelGrid& grid, const std::vector<std::int32_t>& kept,
                           const CellEdges& edges, std::string name);

// Of the cells as full cubes, and with an eighth of each at its corners.
struct VoxelMoments {
  SolidMoments full;
  SolidMoments lumped;
};
VoxelMoments voxel_moments(const VoxelGrid& grid, const std::vector<std::int32_t>& kept);

}  // namespace limber
