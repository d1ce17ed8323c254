#pragma once

#include <cstdint>
#include <vector>

#include "core/model/skin.h"
#include "core/modeller/voxel_lattice.h"

namespace limber {

struct EmbeddedSkin {
  Skin skin;
  double reach = 0.0;  // m, of the vertex farthest from the lattice
};

// Hangs every vertex of the mesh on the nearest cell, and every triangle on the cell nearest to its
// centroid. `cells` in the order of the grid. Skin::cells are those that carry something or have a
// side without neighbour. Throws InputError where a vertex is farther from the cells than
// kMostSkinReach.
EmbeddedSkin embedded_skin(const TriangleMesh& mesh, const VoxelGrid& grid,
                           const std::vector<LatticeCell>& cells);

}  // namespace limber
