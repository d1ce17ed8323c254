#include "core/operators/boundary_operator.h"

#include <algorithm>

namespace limber {
namespace {

std::vector<FaceId> external_faces(const PhysicalModel& model, const BreakingTopology& topology) {
  const BreakingState state = breaking_state(model, topology);
  std::vector<FaceId> faces;
  for (FaceId f : ids_of(model.geometry.faces))
    if (state.face_external[f.index()]) faces.push_back(f);
  return faces;
}

// One triangle for every face; the corners are still those of the physical model.
std::vector<SurfaceTriangle> triangles_of(const PhysicalModel& model, std::span<const FaceId> faces,
                                          std::span<const TwinFace> face_twin) {
  const std::vector<Subobject>& subobjects = model.geometry.subobjects;
  std::vector<SurfaceTriangle> triangles;
  triangles.reserve(faces.size());
  std::size_t subobject = 0;
  for (FaceId f : faces) {
    while (subobject + 1 < subobjects.size() && f.value >= subobjects[subobject].faces.end)
      ++subobject;  // their ranges follow each other
    const auto& [p, q, r] = model.geometry.faces[f].corners;
    // External although it has a reverse: that one's cell is gone.
    const bool was_inner = face_twin[f.index()].face >= 0;
    triangles.push_back({{p.value, q.value, r.value}, f, static_cast<int>(subobject), was_inner});
  }
  return triangles;
}

std::vector<int> used_points(const std::vector<SurfaceTriangle>& triangles) {
  std::vector<int> used;
  used.reserve(3 * triangles.size());
  for (const SurfaceTriangle& triangle : triangles)
    used.insert(used.end(), triangle.corners.begin(), triangle.corners.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

// Keeps the points that triangles use, in increasing order, and renumbers the corners.
void keep_used_points(const PhysicalModel& model, SurfaceModel& surface) {
  const std::vector<int> used = used_points(surface.triangles);
  for (int p : used) {
    surface.source_point.push_back(PointId(static_cast<std::size_t>(p)));
    surface.points.push_back(model.geometry.points[surface.source_point.back()]);
  }
  for (SurfaceTriangle& triangle : surface.triangles)
    for (int& corner : triangle.corners) {
      const auto found = std::lower_bound(used.begin(), used.end(), corner);
      corner = static_cast<int>(found - used.begin());
    }
}

}  // namespace

SurfaceModel boundary(const PhysicalModel& model) {
  return boundary(model, breaking_topology(model.geometry));
}

SurfaceModel boundary(const PhysicalModel& model, const BreakingTopology& topology) {
  return surface_of(model, external_faces(model, topology), topology.face_twin);
}

SurfaceModel surface_of(const PhysicalModel& model, std::span<const FaceId> faces,
                        std::span<const TwinFace> face_twin) {
  SurfaceModel surface;
  surface.triangles = triangles_of(model, faces, face_twin);
  keep_used_points(model, surface);
  for (const Subobject& s : model.geometry.subobjects) surface.subobject_names.push_back(s.name);
  for (const SubobjectAttributes& part : model.parts)
    surface.subobject_surfaces.push_back(part.surface);
  return surface;
}

}  // namespace limber
