#include "core/operators/skin_surface.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/model/disjoint_sets.h"
#include "core/operators/boundary_operator.h"

namespace limber {
namespace {

// Points joined by unbroken edges; the corners of a whole cell are one piece whatever its edges.
DisjointSets joined_points(const PhysicalModel& model) {
  DisjointSets sets(model.points.size());
  for (EdgeId e : ids_of(model.edges)) {
    const Edge& edge = model.geometry.edges[e];
    if (!model.edges[e].broken) sets.join(edge.a.value, edge.b.value);
  }
  for (const Skin& skin : model.skins)
    for (const SkinCell& cell : skin.cells)
      if (model.cells[cell.cell].valid)
        for (PointId corner : cell.corners) sets.join(cell.corners[0].value, corner.value);
  return sets;
}

int subobject_of(const GeometricModel& geometry, CellId cell) {
  const auto& s = geometry.subobjects;
  const auto found = std::partition_point(
      s.begin(), s.end(), [cell](const Subobject& o) { return o.cells.end <= cell.value; });
  return found == s.end() ? -1 : static_cast<int>(found - s.begin());
}

// Adds one skin to a surface.
class SkinDrawing {
 public:
  SkinDrawing(const PhysicalModel& model, const Skin& skin, const DisjointSets& joined,
              SurfaceModel& out)
      : model_(model),
        skin_(skin),
        joined_(joined),
        out_(out),
        in_host_(skin.vertices.size(), -1) {}

  void draw() {
    for (const SkinTriangle& t : skin_.triangles) {
      const CellId owner = skin_.cells[t.owner].cell;
      if (!model_.cells[owner].valid) continue;
      out_.triangles.push_back({{corner(t, 0), corner(t, 1), corner(t, 2)},
                                FaceId(),
                                subobject_of(model_.geometry, owner),
                                false});
    }
  }

 private:
  int corner(const SkinTriangle& t, std::size_t k) {
    const std::int32_t v = t.corners[k];
    const std::int32_t host = skin_.vertices[v].host;
    if (hold_together(host, t.owner)) {
      if (in_host_[v] < 0) in_host_[v] = add(v, host);
      return in_host_[v];
    }
    const auto [entry, is_new] = in_owner_.try_emplace({v, t.owner}, -1);
    if (is_new) entry->second = add(v, t.owner);
    return entry->second;
  }

  bool hold_together(std::int32_t host, std::int32_t owner) const {
    if (host == owner) return true;
    const SkinCell &h = skin_.cells[host], &o = skin_.cells[owner];
    return model_.cells[h.cell].valid &&
           joined_.root(h.corners[0].value) == joined_.root(o.corners[0].value);
  }

  // Cells of one grid continue each other's places.
  int add(std::int32_t v, std::int32_t carrier) {
    const SkinCell &host = skin_.cells[skin_.vertices[v].host], &cell = skin_.cells[carrier];
    Vec3 place = skin_.vertices[v].place;
    for (std::size_t k = 0; k < 3; ++k)
      place[Eigen::Index(k)] += double(host.grid[k]) - double(cell.grid[k]);
    out_.points.push_back(carried_place(model_, cell, place));
    out_.source_point.push_back(cell.corners[0]);
    return static_cast<int>(out_.points.size()) - 1;
  }

  const PhysicalModel& model_;
  const Skin& skin_;
  const DisjointSets& joined_;
  SurfaceModel& out_;
  std::vector<int> in_host_;                                       // vertex -> point, or -1
  std::map<std::pair<std::int32_t, std::int32_t>, int> in_owner_;  // vertex, owner -> point
};

std::vector<std::uint8_t> covered_cells(const PhysicalModel& model) {
  std::vector<std::uint8_t> covered(model.cells.size(), 0);
  for (const Skin& skin : model.skins)
    for (const SkinCell& cell : skin.cells) covered[cell.cell.index()] = 1;
  return covered;
}

// Leaves out the authored faces of these cells, and the points that only those had.
SurfaceModel without_faces_of(const std::vector<std::uint8_t>& covered, const PhysicalModel& model,
                              SurfaceModel surface) {
  std::erase_if(surface.triangles, [&](const SurfaceTriangle& t) {
    const CellId cell = model.geometry.faces[t.source].cell;
    return cell.valid() && covered[cell.index()] && !t.exposed_by_breaking;
  });
  std::vector<int> number(surface.points.size(), -1);
  for (const SurfaceTriangle& t : surface.triangles)
    for (int corner : t.corners) number[corner] = 0;
  int kept = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] < 0) continue;
    surface.points[kept] = surface.points[i];
    surface.source_point[kept] = surface.source_point[i];
    number[i] = kept++;
  }
  surface.points.resize(kept);
  surface.source_point.resize(kept);
  for (SurfaceTriangle& t : surface.triangles)
    for (int& corner : t.corners) corner = number[corner];
  return surface;
}

}  // namespace

Vec3 carried_place(const PhysicalModel& model, const SkinCell& cell, const Vec3& place) {
  Vec3 x = Vec3::Zero();
  for (unsigned c = 0; c < 8; ++c) {
    const double wx = c & 1 ? place.x() : 1.0 - place.x();
    const double wy = c & 2 ? place.y() : 1.0 - place.y();
    const double wz = c & 4 ? place.z() : 1.0 - place.z();
    x += wx * wy * wz * model.geometry.points[cell.corners[c]];
  }
  return x;
}

SurfaceModel skin_surface(const PhysicalModel& model) {
  return skin_surface(model, boundary(model));
}

SurfaceModel skin_surface(const PhysicalModel& model, SurfaceModel boundary) {
  if (model.skins.empty()) return boundary;
  SurfaceModel surface = without_faces_of(covered_cells(model), model, std::move(boundary));
  const DisjointSets joined = joined_points(model);
  for (const Skin& skin : model.skins) SkinDrawing(model, skin, joined, surface).draw();
  return surface;
}

}  // namespace limber
