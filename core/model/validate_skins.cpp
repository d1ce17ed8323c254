#include <algorithm>
#include <vector>

#include "core/model/check_skins.h"

// The checks S1 to S3 of docs/invariants.md.

namespace limber {
namespace {

// What is looked at, for messages: "skin 0: vertex 17".
struct Element {
  std::size_t skin;
  const char* kind;
  std::size_t index;
  std::string name() const { return say("skin ", skin, ": ", kind, " ", index); }
};

bool in_range(const Element& element, const char* role, std::int32_t index, std::size_t count,
              DiagnosticList& out) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return true;
  out.add(element.name(), say("S1 ", role, " ", index, " does not exist, there are ", count),
          "refer to an element that there is");
  return false;
}

// The points of all faces of a cell, each once.
std::vector<PointId> points_of(const GeometricModel& g, const Cell& cell) {
  std::vector<PointId> points;
  for (FaceId f : cell.faces) {
    if (!g.faces.contains(f)) continue;  // G1 says so
    const auto& corners = g.faces[f].corners;
    points.insert(points.end(), corners.begin(), corners.end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

void check_cell(const PhysicalModel& model, const SkinCell& cell, const Element& element,
                DiagnosticList& out) {
  const GeometricModel& g = model.geometry;
  bool exist = in_range(element, "cell", cell.cell.value, g.cells.size(), out);
  for (PointId p : cell.corners)
    exist &= in_range(element, "corner", p.value, g.points.size(), out);
  if (!exist) return;
  std::vector<PointId> corners(cell.corners.begin(), cell.corners.end());
  std::sort(corners.begin(), corners.end());
  if (corners == points_of(g, g.cells[cell.cell])) return;
  out.add(element.name(), say("S2 its corners are not the eight points of cell ", cell.cell.value),
          "hang skins on hexahedral cells, by their own corners");
}

void check_vertex(const Skin& skin, const SkinVertex& vertex, const Element& element,
                  DiagnosticList& out) {
  in_range(element, "host", vertex.host, skin.cells.size(), out);
  const Vec3& p = vertex.place;
  if (p.minCoeff() >= -kMostSkinReach && p.maxCoeff() <= 1.0 + kMostSkinReach && p.allFinite())
    return;
  out.add(element.name(), say("S3 place is (", p[0], ", ", p[1], ", ", p[2], ")"),
          say("give it a host that is nearer, at most ", kMostSkinReach, " cells away"));
}

void check_triangle(const Skin& skin, const SkinTriangle& triangle, const Element& element,
                    DiagnosticList& out) {
  for (std::int32_t corner : triangle.corners)
    in_range(element, "corner", corner, skin.vertices.size(), out);
  in_range(element, "owner", triangle.owner, skin.cells.size(), out);
}

void check_skin(const PhysicalModel& model, std::size_t s, DiagnosticList& out) {
  const Skin& skin = model.skins[s];
  for (std::size_t i = 0; i < skin.cells.size() && !out.full(); ++i)
    check_cell(model, skin.cells[i], {s, "cell", i}, out);
  for (std::size_t i = 0; i < skin.vertices.size() && !out.full(); ++i)
    check_vertex(skin, skin.vertices[i], {s, "vertex", i}, out);
  for (std::size_t i = 0; i < skin.triangles.size() && !out.full(); ++i)
    check_triangle(skin, skin.triangles[i], {s, "triangle", i}, out);
}

}  // namespace

void check_skins(const PhysicalModel& model, DiagnosticList& out) {
  for (std::size_t s = 0; s < model.skins.size() && !out.full(); ++s) check_skin(model, s, out);
}

}  // namespace limber
