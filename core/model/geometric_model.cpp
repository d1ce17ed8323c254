#include "core/model/geometric_model.h"

#include <algorithm>
#include <cassert>
#include <numeric>

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

IndexRows edge_cells(const GeometricModel& model) {
  const auto for_each_link = [&](auto visit) {
    for (std::size_t c = 0; c < model.cells.size(); ++c)
      for (EdgeId e : model.cells[CellId(c)].edges)
        if (model.edges.contains(e)) visit(e.index(), static_cast<std::int32_t>(c));
  };
  IndexRows rows;
  rows.start.assign(model.edges.size() + 1, 0);
  for_each_link([&](std::size_t e, std::int32_t) { ++rows.start[e + 1]; });
  std::partial_sum(rows.start.begin(), rows.start.end(), rows.start.begin());
  rows.items.resize(rows.start.back());
  std::vector<std::int32_t> next(rows.start.begin(), rows.start.end() - 1);
  for_each_link([&](std::size_t e, std::int32_t c) { rows.items[next[e]++] = c; });
  return rows;
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
  around_.push_back({});
  return model_.points.push_back(position_m);
}

EdgeId GeometricModelBuilder::edge(PointId a, PointId b) {
  assert(around_.contains(a) && around_.contains(b) && "add_point first");
  const EdgeId found = find_edge(a, b);
  if (found.valid()) return found;
  const auto [low, high] = std::minmax(a, b);
  return append_edge(low, high);
}

// Walks the shorter of the two lists.
EdgeId GeometricModelBuilder::find_edge(PointId a, PointId b) const {
  const auto [from, to] = around_[a].count <= around_[b].count ? std::pair(a, b) : std::pair(b, a);
  EdgeId e = around_[from].first;
  while (e.valid()) {
    const Edge& edge = model_.edges[e];
    const bool at_b = edge.b == from;
    if ((at_b ? edge.a : edge.b) == to) return e;
    e = next_[e][at_b];
  }
  return e;
}

EdgeId GeometricModelBuilder::append_edge(PointId a, PointId b) {
  const EdgeId e = model_.edges.push_back({a, b});
  next_.push_back({around_[a].first, around_[b].first});
  for (PointId p : {a, b}) {
    around_[p].first = e;
    ++around_[p].count;
  }
  return e;
}

FaceId GeometricModelBuilder::add_face(std::array<PointId, 3> corners) {
  return model_.faces.push_back({starting_with_smallest(corners), CellId()});
}

CellId GeometricModelBuilder::add_cell(std::span<const std::array<PointId, 2>> edges,
                                       std::span<const std::array<PointId, 3>> outward_faces) {
  const CellId id = model_.cells.push_back({});
  model_.cells[id].edges.reserve(edges.size());
  model_.cells[id].faces.reserve(outward_faces.size());
  for (const auto& [a, b] : edges) {
    model_.cells[id].edges.push_back(edge(a, b));
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
  around_ = {};
  next_ = {};
  return std::exchange(model_, {});
}

std::array<std::array<PointId, 3>, 2> split_square(const std::array<PointId, 4>& square) {
  std::array<PointId, 4> s = square;
  std::rotate(s.begin(), std::min_element(s.begin(), s.end()), s.end());
  return {{{s[0], s[1], s[2]}, {s[0], s[2], s[3]}}};
}

}  // namespace limber
