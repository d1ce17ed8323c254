#pragma once

#include <cstdint>
#include <vector>

#include "core/model/physical_model.h"

namespace limber {

// How elements (cells, blocks of cells, edges without a cell) share what they have in common, so
// that stiffness and mass of the whole are the sums of the elements': an edge in equal parts among
// its cells, the mass of a point in proportion to the stiffness around it.

inline bool carries(const EdgeAttributes& edge) { return !edge.broken && edge.stiffness > 0.0; }

inline std::vector<std::int32_t> cells_per_edge(const GeometricModel& geometry) {
  std::vector<std::int32_t> count(geometry.edges.size(), 0);
  for (const Cell& cell : geometry.cells) {
    for (EdgeId e : cell.edges) ++count[e.index()];
  }
  return count;
}

// N/m
inline IdVector<PointId, double> stiffness_around(const PhysicalModel& model) {
  IdVector<PointId, double> sum(model.points.size(), 0.0);
  for (EdgeId e : ids_of(model.edges)) {
    if (!carries(model.edges[e])) continue;
    sum[model.geometry.edges[e].a] += model.edges[e].stiffness;
    sum[model.geometry.edges[e].b] += model.edges[e].stiffness;
  }
  return sum;
}

}  // namespace limber
