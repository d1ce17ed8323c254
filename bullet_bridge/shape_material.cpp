#include "bullet_bridge/shape_material.h"

#include <algorithm>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

using Points = std::span<const std::int32_t>;

// Calls visit(cell) for the whole cells of the points, each once: from the lower end of its first
// edge. No list to sort, and none of what has been seen.
template <class Visit>
void for_each_cell(const Lattice& lattice, Points points, Visit visit) {
  const BreakingTopology& topology = lattice.topology;
  for (std::int32_t p : points) {
    for (std::int32_t i = lattice.point_edges.start[p]; i < lattice.point_edges.start[p + 1]; ++i) {
      if (lattice.point_neighbours[i] < p) continue;
      const std::int32_t edge = lattice.point_edges.items[i];
      for (std::int32_t cell : topology.edge_cells[edge]) {
        const bool first = topology.cell_edges.items[topology.cell_edges.start[cell]] == edge;
        if (first && lattice.breaking.cell_valid[cell]) visit(cell);
      }
    }
  }
}

bool has_cell(const Lattice& lattice, std::int32_t p) {
  const auto& edges = lattice.point_edges[p];
  return std::any_of(edges.begin(), edges.end(),
                     [&](std::int32_t e) { return lattice.breaking.valid_cells[e] > 0; });
}

double volume_of_cell(const Lattice& lattice, std::int32_t cell) {
  const std::int32_t edge = lattice.topology.cell_edges[cell][0];
  const LatticeObject& object = lattice.objects[lattice.point_object[lattice.springs[edge].a]];
  return cell_volume(object.authored.geometry,
                     CellId(static_cast<std::size_t>(cell - object.cells.begin)));
}

// Of all points of its cells, as places among `of`.
std::vector<std::int32_t> points_of_cell(const Lattice& lattice, std::int32_t cell, Points of) {
  std::vector<std::int32_t> found;
  const auto add = [&](std::int32_t p) {
    if (std::find(found.begin(), found.end(), p) == found.end()) found.push_back(p);
  };
  for (std::int32_t e : lattice.topology.cell_edges[cell]) {
    add(lattice.springs[e].a);
    add(lattice.springs[e].b);
  }
  std::sort(found.begin(), found.end());
  for (std::int32_t& p : found) {
    p = static_cast<std::int32_t>(std::lower_bound(of.begin(), of.end(), p) - of.begin());
  }
  return found;
}

ShapeParts parts_of(const Lattice& lattice, Points points, Points with_cells) {
  ShapeParts parts;
  parts.points.start.push_back(0);
  for_each_cell(lattice, points, [&](std::int32_t cell) {
    const std::vector<std::int32_t> corners = points_of_cell(lattice, cell, with_cells);
    parts.points.items.insert(parts.points.items.end(), corners.begin(), corners.end());
    parts.points.start.push_back(static_cast<std::int32_t>(parts.points.items.size()));
    parts.volumes.push_back(volume_of_cell(lattice, cell));
  });
  return parts;
}

}  // namespace

ShapeMaterial shape_material(const Lattice& lattice, Points points, std::span<const Vec3> local) {
  ShapeMaterial material;
  for_each_cell(lattice, points, [&](std::int32_t cell) {
    ++material.parts;
    material.volume += volume_of_cell(lattice, cell);
  });
  std::vector<std::int32_t> with_cells;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (material.parts > 0 && !has_cell(lattice, points[i])) continue;
    with_cells.push_back(points[i]);
    material.points.push_back(local[i]);
  }
  material.list_parts = [&lattice, points, with_cells = std::move(with_cells)] {
    return parts_of(lattice, points, with_cells);
  };
  return material;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
