#include "core/modeller/voxel_pieces.h"

#include <algorithm>
#include <map>

#include "core/model/disjoint_sets.h"

namespace limber {
namespace {

constexpr std::size_t kSpeckCells = 8;  // two by two by two are a body of their own
constexpr double kSpeckShare = 0.01;    // of all cells

// Half of the 6 steps to neighbours by faces, or of the 26 to neighbours by points: those to cells
// earlier in the grid.
std::vector<VoxelIndex> steps_back(bool faces_only) {
  std::vector<VoxelIndex> steps;
  for (std::int32_t z = -1; z <= 1; ++z)
    for (std::int32_t y = -1; y <= 1; ++y)
      for (std::int32_t x = -1; x <= 1; ++x) {
        const bool earlier = z < 0 || (z == 0 && (y < 0 || (y == 0 && x < 0)));
        const bool by_face = std::abs(x) + std::abs(y) + std::abs(z) == 1;
        if (earlier && (by_face || !faces_only)) steps.push_back({x, y, z});
      }
  return steps;
}

DisjointSets joined_cells(const VoxelGrid& grid, const std::vector<std::int32_t>& cells,
                          bool faces_only) {
  DisjointSets sets(cells.size());
  std::vector<std::int32_t> at(grid.size(), -1);
  const std::vector<VoxelIndex> steps = steps_back(faces_only);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto here = static_cast<std::int32_t>(i);
    at[std::size_t(cells[i])] = here;
    const VoxelIndex p = grid.place(std::size_t(cells[i]));
    for (const VoxelIndex& step : steps) {
      const VoxelIndex q = {p[0] + step[0], p[1] + step[1], p[2] + step[2]};
      if (grid.contains(q) && at[grid.index(q)] >= 0) sets.join(at[grid.index(q)], here);
    }
  }
  return sets;
}

// Root -> number of members, 0 for what is no root.
std::vector<std::size_t> sizes_of(const DisjointSets& sets, std::size_t n) {
  std::vector<std::size_t> sizes(n, 0);
  for (std::size_t i = 0; i < n; ++i) ++sizes[sets.root(static_cast<std::int32_t>(i))];
  return sizes;
}

}  // namespace

VoxelPieces voxel_pieces(const VoxelGrid& grid, const std::vector<std::int32_t>& cells) {
  const DisjointSets by_faces = joined_cells(grid, cells, true);
  const DisjointSets by_points = joined_cells(grid, cells, false);
  const std::vector<std::size_t> sizes = sizes_of(by_faces, cells.size());
  std::map<std::int32_t, std::size_t> largest;  // by_points root -> cells of its largest piece
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::size_t& most = largest[by_points.root(static_cast<std::int32_t>(i))];
    most = std::max(most, sizes[i]);
  }
  std::size_t held = 0;
  for (const auto& [root, most] : largest) held += most;
  return {by_faces.count(), by_points.count(), cells.size() - held};
}

std::vector<std::int32_t> without_specks(const VoxelGrid& grid,
                                         const std::vector<std::int32_t>& cells) {
  const DisjointSets sets = joined_cells(grid, cells, false);
  const std::vector<std::size_t> sizes = sizes_of(sets, cells.size());
  const double share = kSpeckShare * static_cast<double>(cells.size());
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t size = sizes[sets.root(static_cast<std::int32_t>(i))];
    if (size >= kSpeckCells || static_cast<double>(size) >= share) kept.push_back(cells[i]);
  }
  return kept;
}

}  // namespace limber
