#include "core/operators/boundary_operator.h"

#include "core/operators/breaking_operator.h"

namespace limber {
namespace {

bool was_inner(const BreakingTopology& topology, std::int32_t face) {
  return topology.face_twin[face] >= 0;  // external now, so its reverse has lost its cell
}

// One triangle for every external face; the corners are still those of the physical model.
std::vector<SurfaceTriangle> external_triangles(const PhysicalModel& model) {
  const BreakingTopology topology = breaking_topology(model.geometry);
  const BreakingState state = breaking_state(model, topology);
  const std::vector<Subobject>& subobjects = model.geometry.subobjects;
  std::vector<SurfaceTriangle> triangles;
  std::size_t subobject = 0;
  for (FaceId f : ids_of(model.geometry.faces)) {
    while (subobject + 1 < subobjects.size() && f.value >= subobjects[subobject].faces.end)
      ++subobject;  // their ranges follow each other
    if (!state.face_external[f.index()]) continue;
    const auto& [p, q, r] = model.geometry.faces[f].corners;
    triangles.push_back({{p.value, q.value, r.value},
                         f,
                         static_cast<int>(subobject),
                         was_inner(topology, f.value)});
  }
  return triangles;
}

// Keeps the points that triangles use, in increasing order, and renumbers the corners.
void keep_used_points(const PhysicalModel& model, SurfaceModel& surface) {
  IdVector<PointId, int> new_index(model.geometry.points.size(), -1);
  const auto at = [&](int corner) -> int& { return new_index[PointId(std::size_t(corner))]; };
  for (const SurfaceTriangle& triangle : surface.triangles)
    for (int corner : triangle.corners) at(corner) = 0;
  for (PointId p : ids_of(model.geometry.points)) {
    if (new_index[p] < 0) continue;
    new_index[p] = static_cast<int>(surface.points.size());
    surface.points.push_back(model.geometry.points[p]);
    surface.source_point.push_back(p);
  }
  for (SurfaceTriangle& triangle : surface.triangles)
    for (int& corner : triangle.corners) corner = at(corner);
}

}  // namespace

SurfaceModel boundary(const PhysicalModel& model) {
  SurfaceModel surface;
  surface.triangles = external_triangles(model);
  keep_used_points(model, surface);
  for (const Subobject& s : model.geometry.subobjects) surface.subobject_names.push_back(s.name);
  surface.subobject_surfaces = model.surfaces;
  return surface;
}

}  // namespace limber
