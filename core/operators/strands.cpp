#include "core/operators/strands.h"

namespace limber {
namespace {

double strand_radius(const PhysicalModel& model, std::size_t subobject) {
  return model.parts[subobject].surface.strand_radius;
}

std::vector<bool> have_edges(const GeometricModel& geometry) {
  std::vector<bool> joined(geometry.points.size(), false);
  for (const Edge& edge : geometry.edges) joined[edge.a.index()] = joined[edge.b.index()] = true;
  return joined;
}

void add_ropes(const PhysicalModel& model, std::vector<Strand>& all) {
  const IndexRows cells = edge_cells(model.geometry);
  for (std::size_t s = 0; s < model.geometry.subobjects.size(); ++s) {
    const double radius = strand_radius(model, s);
    if (radius == 0.0) continue;
    const IdRange<EdgeId>& edges = model.geometry.subobjects[s].edges;
    for (std::int32_t e = edges.begin; e < edges.end; ++e) {
      const EdgeId id(static_cast<std::size_t>(e));
      if (!cells[id.index()].empty() || model.edges[id].broken) continue;
      all.push_back({model.geometry.edges[id].a, model.geometry.edges[id].b, static_cast<int>(s),
                     radius});
    }
  }
}

void add_grains(const PhysicalModel& model, std::vector<Strand>& all) {
  const std::vector<bool> joined = have_edges(model.geometry);
  for (std::size_t s = 0; s < model.geometry.subobjects.size(); ++s) {
    const double radius = strand_radius(model, s);
    if (radius == 0.0) continue;
    const IdRange<PointId>& points = model.geometry.subobjects[s].points;
    for (std::int32_t p = points.begin; p < points.end; ++p) {
      const PointId id(static_cast<std::size_t>(p));
      if (!joined[id.index()]) all.push_back({id, id, static_cast<int>(s), radius});
    }
  }
}

}  // namespace

std::vector<Strand> strands(const PhysicalModel& model) {
  std::vector<Strand> all;
  add_ropes(model, all);
  add_grains(model, all);
  return all;
}

}  // namespace limber
