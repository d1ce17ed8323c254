#include "core/modeller/embedded_skin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/diagnostic_list.h"

namespace limber {
namespace {

// Finds the cell of the lattice nearest to a place.
class NearestCell {
 public:
  NearestCell(const VoxelGrid& grid, const std::vector<LatticeCell>& cells)
      : grid_(grid), at_(grid.size(), -1) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      at_[grid.index(cells[i].place)] = static_cast<std::int32_t>(i);
  }

  struct Found {
    std::int32_t cell = -1;                                     // -1: none within reach
    double distance = std::numeric_limits<double>::infinity();  // m
  };

  // Cubes of cells around the place, from inside out: those of ring r are r - 1 cells away or more.
  Found of(const Vec3& x) const {
    const VoxelIndex middle = grid_.around(x);
    Found best;
    for (std::int32_t ring = 0; ring <= kMostSkinReach + 1.0; ++ring) {
      if (best.distance <= (ring - 1) * grid_.spacing) break;
      look_at_ring(x, middle, ring, best);
    }
    return best;
  }

  bool is_surrounded(const VoxelIndex& p) const {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::int32_t step : {-1, 1}) {
        VoxelIndex neighbour = p;
        neighbour[k] += step;
        if (!grid_.contains(neighbour) || at_[grid_.index(neighbour)] < 0) return false;
      }
    return true;
  }

 private:
  void look_at_ring(const Vec3& x, const VoxelIndex& middle, std::int32_t ring, Found& best) const {
    for (std::int32_t dz = -ring; dz <= ring; ++dz)
      for (std::int32_t dy = -ring; dy <= ring; ++dy) {
        const bool whole_row = std::abs(dz) == ring || std::abs(dy) == ring;
        for (std::int32_t dx = -ring; dx <= ring; dx += whole_row ? 1 : std::max(2 * ring, 1))
          look_at(x, {middle[0] + dx, middle[1] + dy, middle[2] + dz}, best);
      }
  }

  void look_at(const Vec3& x, const VoxelIndex& place, Found& best) const {
    if (!grid_.contains(place)) return;
    const std::int32_t cell = at_[grid_.index(place)];
    if (cell < 0) return;
    const Vec3 low = grid_.lowest_corner(place);
    const Vec3 high = low + Vec3::Constant(grid_.spacing);
    const double distance = (x - x.cwiseMax(low).cwiseMin(high)).norm();
    if (distance < best.distance) best = {cell, distance};
  }

  const VoxelGrid& grid_;
  std::vector<std::int32_t> at_;  // shape (grid): which of the lattice's cells, or -1
};

[[noreturn]] void throw_out_of_reach(const TriangleMesh& mesh, const Vec3& x, double spacing) {
  throw InputError(
      {mesh.name,
       say("its surface at (", x[0], ", ", x[1], ", ", x[2], ") m is more than ", kMostSkinReach,
           " cells of ", spacing, " m away from where it is thick enough for a cell"),
       "give a smaller spacing, or remove what is that thin"});
}

// The lattice's cells that a skin uses, numbered as the skin has them.
class SkinCells {
 public:
  SkinCells(const std::vector<LatticeCell>& cells, Skin& skin)
      : cells_(cells), number_(cells.size(), -1), skin_(skin) {}

  std::int32_t use(std::int32_t cell) {
    if (number_[cell] < 0) {
      number_[cell] = static_cast<std::int32_t>(skin_.cells.size());
      skin_.cells.push_back({cells_[cell].cell, cells_[cell].corners, cells_[cell].place});
    }
    return number_[cell];
  }

 private:
  const std::vector<LatticeCell>& cells_;
  std::vector<std::int32_t> number_;
  Skin& skin_;
};

std::int32_t nearest(const NearestCell& search, const TriangleMesh& mesh, const VoxelGrid& grid,
                     const Vec3& x, double& reach) {
  const NearestCell::Found found = search.of(x);
  if (!(found.distance <= kMostSkinReach * grid.spacing)) throw_out_of_reach(mesh, x, grid.spacing);
  reach = std::max(reach, found.distance);
  return found.cell;
}

}  // namespace

EmbeddedSkin embedded_skin(const TriangleMesh& mesh, const VoxelGrid& grid,
                           const std::vector<LatticeCell>& cells) {
  const NearestCell search(grid, cells);
  EmbeddedSkin out;
  SkinCells used(cells, out.skin);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!search.is_surrounded(cells[i].place)) used.use(static_cast<std::int32_t>(i));
  out.skin.vertices.reserve(mesh.positions.size());
  for (const Vec3& x : mesh.positions) {
    const std::int32_t host = nearest(search, mesh, grid, x, out.reach);
    const Vec3 low = grid.lowest_corner(cells[host].place);
    out.skin.vertices.push_back({used.use(host), (x - low) / grid.spacing});
  }
  out.skin.triangles.reserve(mesh.triangles.size());
  for (const MeshTriangle& t : mesh.triangles) {
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
    out.skin.triangles.push_back({t, used.use(nearest(search, mesh, grid, middle, out.reach))});
  }
  return out;
}

}  // namespace limber
