#include "core/model/validate.h"

#include <cmath>

#include "core/model/check_skins.h"
#include "core/model/check_topology.h"
#include "core/model/diagnostic_list.h"

// The checks P1 to P12 of docs/invariants.md, between those of the geometry and the skins.

namespace limber {
namespace {

bool finite_from(double least, double x) { return std::isfinite(x) && x >= least; }
bool in_unit_interval(double x) { return x >= 0.0 && x <= 1.0; }

bool check_size(const char* array, std::size_t found, std::size_t wanted, DiagnosticList& out) {
  if (found == wanted) return true;
  out.add(array, say("P1 has ", found, " entries for ", wanted),
          "start from with_default_attributes() and change entries, not their number");
  return false;
}

void check_points(const PhysicalModel& model, DiagnosticList& out) {
  for (std::size_t i = 0; i < model.points.size() && !out.full(); ++i) {
    const PointAttributes& point = model.points[PointId(i)];
    if (!(std::isfinite(point.mass) && point.mass > 0.0))
      out.add(say("point ", i), say("P2 mass is ", point.mass, " kg"),
              "give it a finite mass above 0");
    const Vec3& v = point.velocity;
    if (!v.allFinite())
      out.add(say("point ", i), say("P3 velocity is (", v[0], ", ", v[1], ", ", v[2], ") m/s"),
              "give it three finite components");
  }
}

void check_edge(const EdgeAttributes& edge, std::size_t i, DiagnosticList& out) {
  if (!finite_from(0.0, edge.stiffness))
    out.add(say("edge ", i), say("P4 stiffness is ", edge.stiffness, " N/m"),
            "give it a finite value, 0 or above");
  if (!finite_from(0.0, edge.damping))
    out.add(say("edge ", i), say("P4 damping is ", edge.damping, " N s/m"),
            "give it a finite value, 0 or above");
  if (!(std::isfinite(edge.rest_length) && edge.rest_length > 0.0))
    out.add(say("edge ", i), say("P5 rest length is ", edge.rest_length, " m"),
            "give it a finite length above 0; points that coincide cannot be joined");
  if (!(edge.break_threshold > 0.0))
    out.add(say("edge ", i), say("P6 break threshold is ", edge.break_threshold, " m"),
            "give it a stretch above 0, or kUnbreakable");
  if (!(edge.crush_threshold > 0.0))
    out.add(say("edge ", i), say("P6 crush threshold is ", edge.crush_threshold, " m"),
            "give it a shortening above 0, or kUnbreakable");
}

void check_edges(const PhysicalModel& model, DiagnosticList& out) {
  for (std::size_t i = 0; i < model.edges.size() && !out.full(); ++i)
    check_edge(model.edges[EdgeId(i)], i, out);
}

void check_faces(const PhysicalModel& model, DiagnosticList& out) {
  for (std::size_t i = 0; i < model.faces.size() && !out.full(); ++i) {
    const FaceAttributes& face = model.faces[FaceId(i)];
    for (double drag : {face.normal_drag, face.tangential_drag})
      if (!finite_from(0.0, drag))
        out.add(say("face ", i), say("P11 drag coefficient is ", drag),
                "give it a finite value, 0 or above");
  }
}

std::size_t broken_edges(const PhysicalModel& model, const Cell& cell) {
  std::size_t n = 0;
  for (EdgeId e : cell.edges)
    if (model.edges.contains(e) && model.edges[e].broken) ++n;
  return n;
}

void check_cell_states(const PhysicalModel& model, DiagnosticList& out) {
  for (std::size_t i = 0; i < model.cells.size() && !out.full(); ++i) {
    const bool valid = model.cells[CellId(i)].valid;
    const std::size_t broken = broken_edges(model, model.geometry.cells[CellId(i)]);
    if (valid == (broken == 0)) continue;
    out.add(say("cell ", i),
            say("P7 is marked ", valid ? "valid" : "invalid", " with ", broken, " broken edges"),
            "break edges with break_edges() only");
  }
}

bool has_cells_all_invalid(const PhysicalModel& model, std::span<const std::int32_t> cells) {
  for (std::int32_t c : cells)
    if (model.cells[CellId(std::size_t(c))].valid) return false;
  return !cells.empty();
}

void check_edge_states(const PhysicalModel& model, DiagnosticList& out) {
  const IndexRows cells_of = edge_cells(model.geometry);
  for (std::size_t i = 0; i < model.edges.size() && !out.full(); ++i) {
    const std::span<const std::int32_t> cells = cells_of[i];
    if (model.edges[EdgeId(i)].broken || !has_cells_all_invalid(model, cells)) continue;
    out.add(say("edge ", i),
            say("P8 is whole, but all of its ", cells.size(), " cells are invalid"),
            "break edges with break_edges() only");
  }
}

void check_object(const ObjectAttributes& object, DiagnosticList& out) {
  if (!finite_from(0.0, object.friction))
    out.add("object", say("P9 friction is ", object.friction),
            "give it a finite value, 0 or above");
  if (!in_unit_interval(object.restitution))
    out.add("object", say("P9 restitution is ", object.restitution), "give it a value from 0 to 1");
  if (!finite_from(0.0, object.internal_damping))
    out.add("object", say("P9 internal damping is ", object.internal_damping, " 1/s"),
            "give it a finite value, 0 or above");
  if (!finite_from(0.0, object.particle_radius))
    out.add("object", say("P9 particle radius is ", object.particle_radius, " m"),
            "give it a finite value, 0 (no contact) or above");
  if (!(object.contact_share >= 0.0 && object.contact_share <= 0.45))
    out.add("object", say("P9 contact share is ", object.contact_share),
            "give it a share of the shortest edge from 0 (no contact) to 0.45");
  if (!finite_from(1.0, object.softening))
    out.add("object", say("P9 softening is ", object.softening),
            "give it a finite value, 1 (none) or above");
}

void check_part(const SubobjectAttributes& part, std::size_t i, DiagnosticList& out) {
  const SurfaceProperties& s = part.surface;
  for (double x : {s.colour[0], s.colour[1], s.colour[2], s.specularity, s.transparency})
    if (!in_unit_interval(x))
      out.add(say("part ", i), say("P10 has a colour, specularity or transparency of ", x),
              "give it values from 0 to 1");
  if (!finite_from(0.0, s.strand_radius))
    out.add(say("part ", i), say("P10 strand radius is ", s.strand_radius, " m"),
            "give it a finite value, 0 or above");
  if (!finite_from(1.0, s.index_of_refraction))
    out.add(say("part ", i), say("P10 index of refraction is ", s.index_of_refraction),
            "give it a finite value, 1 (a vacuum) or above");
  for (const auto& [name, x] : part.values)
    if (!std::isfinite(x))
      out.add(say("part ", i), say("P12 value '", name, "' is ", x), "give it a finite value");
}

void check_parts(const PhysicalModel& model, DiagnosticList& out) {
  if (model.parts.size() != model.geometry.subobjects.size())
    out.add("parts",
            say("P10 has ", model.parts.size(), " entries for ", model.geometry.subobjects.size(),
                " subobjects"),
            "give every subobject one");
  for (std::size_t i = 0; i < model.parts.size() && !out.full(); ++i)
    check_part(model.parts[i], i, out);
}

void check_physics(const PhysicalModel& model, DiagnosticList& out) {
  const GeometricModel& g = model.geometry;
  check_size("point attributes", model.points.size(), g.points.size(), out);
  const bool edges = check_size("edge attributes", model.edges.size(), g.edges.size(), out);
  check_size("face attributes", model.faces.size(), g.faces.size(), out);
  const bool cells = check_size("cell attributes", model.cells.size(), g.cells.size(), out);
  check_points(model, out);
  check_edges(model, out);
  check_faces(model, out);
  if (edges && cells) {
    check_cell_states(model, out);
    check_edge_states(model, out);
  }
  check_object(model.object, out);
  check_parts(model, out);
  check_skins(model, out);
}

}  // namespace

std::vector<Diagnostic> validate(const PhysicalModel& model, std::size_t most) {
  DiagnosticList out(model.name, most);
  check_topology(model.geometry, out);
  check_physics(model, out);
  return out.take();
}

void require_valid(const PhysicalModel& model) {
  const std::vector<Diagnostic> found = validate(model, 1);
  if (!found.empty()) throw InputError(found.front());
}

}  // namespace limber
