#include <algorithm>
#include <array>
#include <utility>

#include "core/model/check_topology.h"
#include "core/model/diagnostic_list.h"
#include "core/model/validate.h"

// The checks G1 to G11 of docs/invariants.md. No check trusts another: each one tests that an index
// is in range before it uses it, so a model with any numbers in it can be looked at.

namespace limber {
namespace {

using DirectedSide = std::array<PointId, 2>;

std::string name_of(PointId p) { return say("point ", p.value); }
std::string name_of(EdgeId e) { return say("edge ", e.value); }
std::string name_of(FaceId f) { return say("face ", f.value); }
std::string name_of(CellId c) { return say("cell ", c.value); }

// Ids of `items`, cut short once the list of diagnostics is full.
template <class IdType, class T, class Check>
void for_each_id(const IdVector<IdType, T>& items, const DiagnosticList& out, Check check) {
  for (std::size_t i = 0; i < items.size() && !out.full(); ++i) check(IdType(i));
}

template <class Owner, class IdType, class T>
bool in_range(const IdVector<IdType, T>& items, IdType id, Owner owner, const char* role,
              DiagnosticList& out) {
  if (items.contains(id)) return true;
  out.add(name_of(owner),
          say("G1 ", role, " ", id.value, " does not exist, there are ", items.size()),
          "refer to an element that was added before");
  return false;
}

bool corners_in_range(const GeometricModel& model, const Face& face) {
  return std::all_of(face.corners.begin(), face.corners.end(),
                     [&](PointId p) { return model.points.contains(p); });
}

std::array<DirectedSide, 3> sides_of(const Face& face) {
  const auto& [p, q, r] = face.corners;
  return {{{p, q}, {q, r}, {r, p}}};
}

void check_points(const GeometricModel& model, DiagnosticList& out) {
  for_each_id(model.points, out, [&](PointId p) {
    const Vec3& x = model.points[p];
    if (x.allFinite()) return;
    out.add(name_of(p), say("G10 position is (", x[0], ", ", x[1], ", ", x[2], ") m"),
            "give it three finite coordinates");
  });
}

void check_ends(const GeometricModel& model, DiagnosticList& out) {
  for_each_id(model.edges, out, [&](EdgeId e) {
    const Edge& edge = model.edges[e];
    in_range(model.points, edge.a, e, "end point", out);
    in_range(model.points, edge.b, e, "end point", out);
    if (edge.a == edge.b)
      out.add(name_of(e), say("G2 both ends are point ", edge.a.value),
              "join two different points");
  });
}

// Two springs side by side would carry twice the load and break one after the other.
void check_parallel_edges(const GeometricModel& model, DiagnosticList& out) {
  std::vector<std::pair<DirectedSide, EdgeId>> sorted;
  sorted.reserve(model.edges.size());
  for (EdgeId e : ids_of(model.edges)) {
    const auto [low, high] = std::minmax(model.edges[e].a, model.edges[e].b);
    sorted.push_back({{low, high}, e});
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const auto& [ends, e] = sorted[i];
    if (sorted[i - 1].first != ends) continue;
    out.add(name_of(e),
            say("G2 joins points ", ends[0].value, " and ", ends[1].value, ", as edge ",
                sorted[i - 1].second.value, " does"),
            "keep one edge for each pair of points");
  }
}

std::string text_of(const std::array<PointId, 3>& corners) {
  return say("(", corners[0].value, ", ", corners[1].value, ", ", corners[2].value, ")");
}

void check_corners(const GeometricModel& model, FaceId f, DiagnosticList& out) {
  const std::array<PointId, 3>& corners = model.faces[f].corners;
  const auto& [p, q, r] = corners;
  for (PointId corner : corners) in_range(model.points, corner, f, "corner point", out);
  if (p == q || q == r || r == p)
    out.add(name_of(f), "G3 corners " + text_of(corners) + " are not distinct",
            "use three different points");
  else if (starting_with_smallest(corners) != corners)
    out.add(name_of(f), "G3 corners " + text_of(corners) + " do not start with the smallest id",
            "rotate them with starting_with_smallest()");
}

void check_faces(const GeometricModel& model, DiagnosticList& out) {
  for_each_id(model.faces, out, [&](FaceId f) {
    check_corners(model, f, out);
    const CellId cell = model.faces[f].cell;
    if (cell != CellId()) in_range(model.cells, cell, f, "cell", out);
  });
}

// Two cells on the same side of one triangle overlap, and no reverse face is unique any more.
void check_equal_faces(const GeometricModel& model, DiagnosticList& out) {
  std::vector<std::pair<std::array<PointId, 3>, FaceId>> sorted;
  sorted.reserve(model.faces.size());
  for (FaceId f : ids_of(model.faces))
    if (model.faces[f].cell.valid()) sorted.push_back({model.faces[f].corners, f});
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const auto& [corners, f] = sorted[i];
    if (sorted[i - 1].first != corners) continue;
    out.add(name_of(f),
            say("G11 has the corners ", text_of(corners), " of face ", sorted[i - 1].second.value,
                ", in the same order"),
            "turn the face of the cell that it does not look out of, or remove the doubled cell");
  }
}

// G4, seen from the cell: what it lists exists, once, and its faces are its own.
void check_lists(const GeometricModel& model, CellId c, DiagnosticList& out) {
  const Cell& cell = model.cells[c];
  if (cell.edges.empty() || cell.faces.empty())
    out.add(name_of(c),
            say("G4 has ", cell.edges.size(), " edges and ", cell.faces.size(), " faces"),
            "give it at least one of each, or remove it");
  for (EdgeId e : cell.edges) in_range(model.edges, e, c, "edge", out);
  for (FaceId f : cell.faces) {
    if (!in_range(model.faces, f, c, "face", out) || model.faces[f].cell == c) continue;
    out.add(name_of(c),
            say("G4 lists face ", f.value, ", which belongs to cell ", model.faces[f].cell.value),
            "give every cell faces of its own");
  }
  std::vector<EdgeId> edges = cell.edges;
  std::sort(edges.begin(), edges.end());
  const auto twice = std::adjacent_find(edges.begin(), edges.end());
  if (twice != edges.end())
    out.add(name_of(c), say("G4 lists edge ", twice->value, " twice"), "list every edge once");
}

// G4, seen from the face.
void check_listed_once(const GeometricModel& model, DiagnosticList& out) {
  IdVector<FaceId, int> times_listed(model.faces.size(), 0);
  for (const Cell& cell : model.cells)
    for (FaceId f : cell.faces)
      if (model.faces.contains(f)) ++times_listed[f];
  for_each_id(model.faces, out, [&](FaceId f) {
    const CellId cell = model.faces[f].cell;
    if (!model.cells.contains(cell) || times_listed[f] == 1) return;
    out.add(name_of(f),
            say("G4 belongs to cell ", cell.value, " but is listed ", times_listed[f], " times"),
            "list it once, in its cell");
  });
}

bool lists_in_range(const GeometricModel& model, const Cell& cell) {
  return std::all_of(cell.edges.begin(), cell.edges.end(),
                     [&](EdgeId e) { return model.edges.contains(e); }) &&
         std::all_of(cell.faces.begin(), cell.faces.end(), [&](FaceId f) {
           return model.faces.contains(f) && corners_in_range(model, model.faces[f]);
         });
}

std::vector<DirectedSide> sorted_sides(const GeometricModel& model, const Cell& cell) {
  std::vector<DirectedSide> sides;
  for (FaceId f : cell.faces)
    for (const DirectedSide& side : sides_of(model.faces[f])) sides.push_back(side);
  std::sort(sides.begin(), sides.end());
  return sides;
}

// The sides whose reverse is not there: none for a closed surface, the outline of a polygon.
std::vector<DirectedSide> open_sides(const std::vector<DirectedSide>& sides) {
  std::vector<DirectedSide> open;
  for (const auto& [p, q] : sides)
    if (!std::binary_search(sides.begin(), sides.end(), DirectedSide{q, p})) open.push_back({p, q});
  return open;
}

// True when the sides, followed from end to start, make one loop through `corners` different
// points.
bool is_one_loop(const std::vector<DirectedSide>& open, std::size_t corners) {
  PointId at = open.front()[0];
  for (std::size_t steps = 1; steps <= open.size(); ++steps) {
    const auto next = std::lower_bound(open.begin(), open.end(), DirectedSide{at, PointId()});
    if (next == open.end() || (*next)[0] != at) return false;
    at = (*next)[1];
    if (at == open.front()[0]) return steps == open.size() && steps == corners;
  }
  return false;
}

std::size_t count_corners(const std::vector<DirectedSide>& sorted_sides) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < sorted_sides.size(); ++i)
    if (i == 0 || sorted_sides[i][0] != sorted_sides[i - 1][0]) ++n;
  return n;
}

// G7. A closed cell that lost a face leaves an open loop too, but one that misses some corners.
void check_surface(CellId c, const std::vector<DirectedSide>& sides,
                   const std::vector<DirectedSide>& open, DiagnosticList& out) {
  const auto twice = std::adjacent_find(sides.begin(), sides.end());
  if (twice != sides.end())
    out.add(name_of(c),
            say("G7 two faces run along their side from point ", (*twice)[0].value, " to point ",
                (*twice)[1].value, " the same way"),
            "order the corners of all faces anticlockwise seen from outside");
  else if (!open.empty() && !is_one_loop(open, count_corners(sides)))
    out.add(name_of(c),
            say("G7 the side from point ", open.front()[0].value, " to point ",
                open.front()[1].value, " of a face has no reverse"),
            "close the cell's surface, or make it one flat polygon without inner points");
}

// G6. A diagonal that splits a square side of the cell need not be a spring: the paper adds such
// edges "to make the cell more rigid". So a side without an edge has to lie between two faces.
void check_sides_are_edges(const GeometricModel& model, CellId c,
                           const std::vector<DirectedSide>& sides,
                           const std::vector<DirectedSide>& open, DiagnosticList& out) {
  std::vector<DirectedSide> edges;
  std::vector<PointId> ends;
  for (EdgeId e : model.cells[c].edges) {
    const auto& [a, b] = model.edges[e];
    edges.insert(edges.end(), {DirectedSide{a, b}, DirectedSide{b, a}});
    ends.insert(ends.end(), {a, b});
  }
  std::sort(edges.begin(), edges.end());
  std::sort(ends.begin(), ends.end());
  for (const auto& [p, q] : open) {
    if (std::binary_search(edges.begin(), edges.end(), DirectedSide{p, q})) continue;
    out.add(
        name_of(c),
        say("G6 its outline from point ", p.value, " to point ", q.value, " is not an edge of it"),
        "add that edge to the cell");
  }
  PointId last;
  for (const auto& [p, q] : sides) {
    if (p != std::exchange(last, p) && !std::binary_search(ends.begin(), ends.end(), p))
      out.add(name_of(c), say("G6 point ", p.value, " is a corner of a face but of no edge of it"),
              "add the edges that hold the point to the cell");
  }
}

void check_cells(const GeometricModel& model, DiagnosticList& out) {
  for_each_id(model.cells, out, [&](CellId c) {
    check_lists(model, c, out);
    if (!lists_in_range(model, model.cells[c])) return;
    const std::vector<DirectedSide> sides = sorted_sides(model, model.cells[c]);
    const std::vector<DirectedSide> open = open_sides(sides);
    check_sides_are_edges(model, c, sides, open, out);
    check_surface(c, sides, open, out);
  });
}

void check_volumes(const GeometricModel& model, DiagnosticList& out) {
  for_each_id(model.cells, out, [&](CellId c) {
    if (!lists_in_range(model, model.cells[c])) return;
    if (!open_sides(sorted_sides(model, model.cells[c])).empty()) return;  // a polygon
    const double volume = cell_volume(model, c);
    if (model.cells[c].faces.empty() || !(volume <= 0.0)) return;
    out.add(
        name_of(c), say("G8 volume is ", volume, " m^3"),
        "order the corners of its faces anticlockwise seen from outside, and do not flatten it");
  });
}

template <class Range>
void check_level(const std::vector<Subobject>& subobjects, Range Subobject::*range,
                 std::size_t size, const char* level, DiagnosticList& out) {
  std::int64_t expected = 0;
  for (std::size_t i = 0; i < subobjects.size(); ++i) {
    const Range& r = subobjects[i].*range;
    if (r.begin != expected || r.end < r.begin)
      out.add(say("subobject ", i, " (", subobjects[i].name, ")"),
              say("G9 has ", level, " ", r.begin, " to ", r.end, ", not from ", expected, " up"),
              "let every subobject begin where the one before ends");
    expected = r.end;
  }
  if (expected != static_cast<std::int64_t>(size))
    out.add(subobjects.empty()
                ? "subobjects"
                : say("subobject ", subobjects.size() - 1, " (", subobjects.back().name, ")"),
            say("G9 ", level, " end at ", expected, ", the model has ", size),
            "let the last subobject end where the model ends");
}

void check_subobjects(const GeometricModel& model, DiagnosticList& out) {
  const std::vector<Subobject>& s = model.subobjects;
  check_level(s, &Subobject::points, model.points.size(), "points", out);
  check_level(s, &Subobject::edges, model.edges.size(), "edges", out);
  check_level(s, &Subobject::faces, model.faces.size(), "faces", out);
  check_level(s, &Subobject::cells, model.cells.size(), "cells", out);
}

}  // namespace

void check_topology(const GeometricModel& model, DiagnosticList& out) {
  check_points(model, out);
  check_ends(model, out);
  check_parallel_edges(model, out);
  check_faces(model, out);
  check_equal_faces(model, out);
  check_cells(model, out);
  check_listed_once(model, out);
  check_subobjects(model, out);
}

std::vector<Diagnostic> validate(const GeometricModel& model, const std::string& name,
                                 std::size_t most) {
  DiagnosticList out(name, most);
  check_topology(model, out);
  check_volumes(model, out);
  return out.take();
}

}  // namespace limber
