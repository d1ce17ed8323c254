#include "core/model/geometric_model.h"

#include <algorithm>
#include <cassert>

namespace limber {

std::array<PointId, 3> starting_with_smallest(std::array<PointId, 3> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::array<PointId, 3> reversed(std::array<PointId, 3> corners) {
  return starting_with_smallest({corners[0], corners[2], corners[1]});
}

double cell_volume(const GeometricModel& model, CellId cell) {
  const std::vector<FaceId>& faces = model.cells[cell].faces;
  if (faces.empty()) return 0.0;
  // Relative to one corner: exact far from the origin as well.
  const Vec3 origin = model.points[model.faces[faces.front()].corners[0]];
  double six_volumes = 0.0;
  for (FaceId f : faces) {
    const auto& [p, q, r] = model.faces[f].corners;
    const Vec3 a = model.points[p] - origin;
    const Vec3 b = model.points[q] - origin;
    const Vec3 c = model.points[r] - origin;
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

void GeometricModelBuilder::begin_subobject(std::string name) {
  close_subobject();
  Subobject s;
  s.name = std::move(name);
  s.points.begin = static_cast<std::int32_t>(model_.points.size());
  s.edges.begin = static_cast<std::int32_t>(model_.edges.size());
  s.faces.begin = static_cast<std::int32_t>(model_.faces.size());
  s.cells.begin = static_cast<std::int32_t>(model_.cells.size());
  model_.subobjects.push_back(std::move(s));
}

void GeometricModelBuilder::close_subobject() {
  if (model_.subobjects.empty()) return;
  Subobject& s = model_.subobjects.back();
  s.points.end = static_cast<std::int32_t>(model_.points.size());
  s.edges.end = static_cast<std::int32_t>(model_.edges.size());
  s.faces.end = static_cast<std::int32_t>(model_.faces.size());
  s.cells.end = static_cast<std::int32_t>(model_.cells.size());
}

PointId GeometricModelBuilder::add_point(const Vec3& position_m) {
  assert(!model_.subobjects.empty() && "begin_subobject first");
  return model_.points.push_back(position_m);
}

EdgeId GeometricModelBuilder::edge(PointId a, PointId b) {
  const auto [low, high] = std::minmax(a, b);
  const std::uint64_t key = (std::uint64_t(low.index()) << 32) | std::uint64_t(high.index());
  const auto [found, inserted] = edge_of_points_.try_emplace(key);
  if (inserted) {
    found->second = model_.edges.push_back({low, high});
    model_.edge_cells.push_back({});
  }
  return found->second;
}

FaceId GeometricModelBuilder::add_face(std::array<PointId, 3> corners) {
  return model_.faces.push_back({starting_with_smallest(corners), CellId()});
}

CellId GeometricModelBuilder::add_cell(std::span<const std::array<PointId, 2>> edges,
                                       std::span<const std::array<PointId, 3>> outward_faces) {
  const CellId id = model_.cells.push_back({});
  for (const auto& [a, b] : edges) {
    const EdgeId e = edge(a, b);
    model_.cells[id].edges.push_back(e);
    model_.edge_cells[e].push_back(id);
  }
  for (const auto& corners : outward_faces) {
    const FaceId f = add_face(corners);
    model_.faces[f].cell = id;
    model_.cells[id].faces.push_back(f);
  }
  return id;
}

GeometricModel GeometricModelBuilder::finish() {
  close_subobject();
  edge_of_points_.clear();
  return std::exchange(model_, {});
}

std::array<std::array<PointId, 3>, 2> split_square(const std::array<PointId, 4>& square) {
  std::array<PointId, 4> s = square;
  std::rotate(s.begin(), std::min_element(s.begin(), s.end()), s.end());
  return {{{s[0], s[1], s[2]}, {s[0], s[2], s[3]}}};
}

}  // namespace limber
