#include "core/operators/gluing_operator.h"

#include <algorithm>
#include <cmath>

#include "core/model/diagnostic_list.h"
#include "core/model/validate.h"
#include "core/operators/glue_notes.h"
#include "core/operators/point_pairs.h"

namespace limber {
namespace {

// Points nearer than this share of the glue distance coincide: a bond that short would be torn by
// any motion at all.
constexpr double kCoincidence = 1e-9;

bool finite_and_not_negative(double x) { return std::isfinite(x) && x >= 0.0; }

void require_usable(const GlueBond& bond) {
  const auto refuse = [](const char* what, double x, const char* remedy) {
    throw InputError({"glue bond", say(what, " is ", x), remedy});
  };
  if (!(std::isfinite(bond.distance) && bond.distance > 0.0))
    refuse("distance (m)", bond.distance, "give a finite distance above 0");
  if (!finite_and_not_negative(bond.stiffness))
    refuse("stiffness (N/m)", bond.stiffness, "give a finite value, 0 or above");
  if (!finite_and_not_negative(bond.damping))
    refuse("damping (N s/m)", bond.damping, "give a finite value, 0 or above");
  if (!(bond.break_strain > 0.0))
    refuse("break strain", bond.break_strain, "give a strain above 0, or kUnbreakable");
  if (!(bond.crush_strain > 0.0))
    refuse("crush strain", bond.crush_strain, "give a strain above 0, or kUnbreakable");
}

// "handle: point 3, 1.5 mm from spout: point 9" and what can be done about it.
[[noreturn]] void throw_too_far(const PhysicalModel& a, const PhysicalModel& b,
                                const GlueBond& bond) {
  const std::string remedy = "move the models nearer, or raise the glue distance";
  if (a.points.empty() || b.points.empty())
    throw InputError({(a.points.empty() ? a : b).name, "has no points to glue", "add some"});
  const PointPair pair = nearest_pair(a.geometry.points, b.geometry.points);
  throw InputError(
      {say(a.name, ": point ", pair.a.value),
       say("is the point nearest to ", b.name, ", ", pair.distance, " m from its point ",
           pair.b.value, ", but glue reaches ", bond.distance, " m"),
       remedy});
}

[[noreturn]] void throw_coincident(const PhysicalModel& a, const PhysicalModel& b,
                                   const PointPair& pair) {
  throw InputError({say(a.name, ": point ", pair.a.value),
                    say("coincides with point ", pair.b.value, " of ", b.name, " (", pair.distance,
                        " m): a bond between them has no direction"),
                    "leave a gap between the models"});
}

std::vector<PointPair> pairs_to_bond(const PhysicalModel& a, const PhysicalModel& b,
                                     const GlueBond& bond) {
  std::vector<PointPair> pairs = pairs_within(a.geometry.points, b.geometry.points, bond.distance);
  if (pairs.empty()) throw_too_far(a, b, bond);
  for (const PointPair& pair : pairs)
    if (pair.distance <= std::max(bond.distance * kCoincidence, pair.rounding))
      throw_coincident(a, b, pair);
  return bond.one_to_one ? one_to_one(std::move(pairs)) : pairs;
}

template <class IdType>
void shift(IdType& id, std::size_t offset) {
  if (id.valid()) id = IdType(id.index() + offset);
}

template <class IdType>
void shift(std::vector<IdType>& ids, std::size_t offset) {
  for (IdType& id : ids) shift(id, offset);
}

// Renumbers everything in `g` as it will be called behind `first`.
void shift_behind(const GeometricModel& first, GeometricModel& g) {
  const std::size_t points = first.points.size(), edges = first.edges.size();
  const std::size_t faces = first.faces.size(), cells = first.cells.size();
  for (Edge& edge : g.edges) {
    shift(edge.a, points);
    shift(edge.b, points);
  }
  for (Face& face : g.faces) {
    for (PointId& corner : face.corners) shift(corner, points);
    shift(face.cell, cells);
  }
  for (Cell& cell : g.cells) {
    shift(cell.edges, edges);
    shift(cell.faces, faces);
  }
  for (Subobject& s : g.subobjects)
    s = {s.name, s.points.shifted_by(points), s.edges.shifted_by(edges), s.faces.shifted_by(faces),
         s.cells.shifted_by(cells)};
}

void append(GeometricModel& g, GeometricModel second) {
  shift_behind(g, second);
  g.points.append(second.points);
  g.edges.append(second.edges);
  g.faces.append(second.faces);
  g.cells.append(second.cells);
  g.subobjects.insert(g.subobjects.end(), second.subobjects.begin(), second.subobjects.end());
}

void append(std::vector<Skin>& skins, std::vector<Skin> second, const GeometricModel& first) {
  for (Skin& skin : second) {
    for (SkinCell& cell : skin.cells) {
      shift(cell.cell, first.cells.size());
      for (PointId& corner : cell.corners) shift(corner, first.points.size());
    }
    skins.push_back(std::move(skin));
  }
}

// All of `b` behind `a`; what belongs to the object as a whole stays that of `a`.
PhysicalModel side_by_side(const PhysicalModel& a, const PhysicalModel& b) {
  PhysicalModel both = a;
  both.name = a.name + " + " + b.name;
  append(both.geometry, b.geometry);
  both.points.append(b.points);
  both.edges.append(b.edges);
  both.faces.append(b.faces);
  both.cells.append(b.cells);
  both.parts.insert(both.parts.end(), b.parts.begin(), b.parts.end());
  append(both.skins, b.skins, a.geometry);
  return both;
}

void add_bond(PhysicalModel& both, PointId end_a, PointId end_b, double length_m,
              const GlueBond& bond) {
  both.geometry.edges.push_back({end_a, end_b});  // of no cell: breaking it invalidates none
  both.edges.push_back({.stiffness = bond.stiffness,
                        .damping = bond.damping,
                        .rest_length = length_m,
                        .break_threshold = bond.break_strain * length_m,
                        .crush_threshold = bond.crush_strain * length_m});
}

// A subobject of edges alone: its other ranges are empty and stand at the end, so that the
// subobjects still partition every level in order (G9).
Subobject glue_subobject(const PhysicalModel& both, std::string name) {
  const GeometricModel& g = both.geometry;
  Subobject s;
  s.name = std::move(name);
  s.points = s.points.shifted_by(g.points.size());
  s.edges = s.edges.shifted_by(g.edges.size());
  s.faces = s.faces.shifted_by(g.faces.size());
  s.cells = s.cells.shifted_by(g.cells.size());
  return s;
}

}  // namespace

GlueResult glue(const PhysicalModel& a, const PhysicalModel& b, const GlueBond& bond) {
  require_usable(bond);
  require_valid(a);
  require_valid(b);
  const std::vector<PointPair> pairs = pairs_to_bond(a, b, bond);

  PhysicalModel both = side_by_side(a, b);
  Subobject glued = glue_subobject(both, "glue: " + a.name + " + " + b.name);
  for (const PointPair& pair : pairs)
    add_bond(both, pair.a, PointId(pair.b.index() + a.points.size()), pair.distance, bond);
  glued.edges.end = static_cast<std::int32_t>(both.geometry.edges.size());
  both.geometry.subobjects.push_back(std::move(glued));
  both.parts.emplace_back();
  return {std::move(both), pairs.size(), glue_notes(a, b, glue_seam(a, b, pairs))};
}

}  // namespace limber
