#include <algorithm>
#include <array>
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

// Where corner number c is in a cube of side 1.
std::array<int, 3> place_of(std::ptrdiff_t c) { return {int(c & 1), int(c >> 1 & 1), int(c >> 2)}; }

// Do these corners lie in one side of the cube, anticlockwise seen from outside? Then
// (b - a) x (c - a) is the side's unit normal.
bool is_on_a_side(const std::array<std::ptrdiff_t, 3>& corners) {
  const auto a = place_of(corners[0]), b = place_of(corners[1]), c = place_of(corners[2]);
  int axes = 0;
  bool outward = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    const int normal = (b[l] - a[l]) * (c[m] - a[m]) - (b[m] - a[m]) * (c[l] - a[l]);
    if (normal == 0) continue;
    ++axes;
    outward = outward && (normal > 0) == (a[k] == 1);
  }
  return axes == 1 && outward;
}

// The order is that of some right-handed axes when the cell's faces are the sides of the cube.
// Which way these axes point, nobody can tell. The corners have to be the cell's points.
bool in_order(const GeometricModel& g, const SkinCell& cell) {
  const auto number = [&](PointId p) {
    return std::find(cell.corners.begin(), cell.corners.end(), p) - cell.corners.begin();
  };
  const std::vector<FaceId>& faces = g.cells[cell.cell].faces;
  return std::all_of(faces.begin(), faces.end(), [&](FaceId f) {
    if (!g.faces.contains(f)) return true;  // G1 says so
    const auto& [a, b, c] = g.faces[f].corners;
    return is_on_a_side({number(a), number(b), number(c)});
  });
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
  if (corners != points_of(g, g.cells[cell.cell])) {
    out.add(element.name(),
            say("S2 its corners are not the eight points of cell ", cell.cell.value),
            "hang skins on hexahedral cells, by their own corners");
  } else if (!in_order(g, cell)) {
    out.add(element.name(), say("S2 its corners are not in the order of cell ", cell.cell.value),
            "put corner c on the +x side for c & 1, +y for c & 2, +z for c & 4");
  }
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
