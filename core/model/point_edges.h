#pragma once

#include "core/model/geometric_model.h"
#include "core/model/index_rows.h"

namespace limber {

// The way back from points to edges: row p lists the edges of point p, ascending.
inline IndexRows point_edges(const GeometricModel& geometry) {
  IndexRows rows;
  rows.start.assign(geometry.points.size() + 1, 0);
  for (const Edge& e : geometry.edges) ++rows.start[e.a.value + 1], ++rows.start[e.b.value + 1];
  for (std::size_t p = 0; p < geometry.points.size(); ++p) rows.start[p + 1] += rows.start[p];
  rows.items.resize(rows.start.back());
  std::vector<std::int32_t> next(rows.start.begin(), rows.start.end() - 1);
  for (EdgeId e : ids_of(geometry.edges)) {
    rows.items[next[geometry.edges[e].a.value]++] = e.value;
    rows.items[next[geometry.edges[e].b.value]++] = e.value;
  }
  return rows;
}

}  // namespace limber
