#include "core/dynamics/lattice.h"

#include <algorithm>
#include <cmath>

#include "core/contact/penalty.h"
#include "core/dynamics/spring_force.h"
#include "core/dynamics/stable_step.h"
#include "core/model/validate.h"

namespace limber {
namespace {

// Contact radius of a point as a share of its shortest edge: two neighbours' spheres must not
// overlap at rest, or breaking their edge would set free contact energy.
constexpr double kContactRadiusShare = 0.45;

// The chosen step keeps this distance from the bound: the bound is that of the undeformed lattice
// with one contact a point and does not know friction (a twentieth, see kFrictionShare).
constexpr double kStepSafety = 0.92;

IndexRows shifted_rows_appended(IndexRows rows, const IndexRows& more, std::int32_t offset) {
  if (rows.start.empty()) rows.start.push_back(0);
  const std::int32_t base = rows.start.back();
  for (std::size_t r = 1; r < more.start.size(); ++r) rows.start.push_back(base + more.start[r]);
  for (std::int32_t item : more.items) rows.items.push_back(item + offset);
  return rows;
}

void append_shifted(std::vector<std::int32_t>& to, const std::vector<std::int32_t>& from,
                    std::int32_t offset) {
  for (std::int32_t i : from) to.push_back(i < 0 ? i : i + offset);
}

void append_topology(BreakingTopology& to, const BreakingTopology& from, std::int32_t edges,
                     std::int32_t cells, std::int32_t faces) {
  to.cell_edges = shifted_rows_appended(std::move(to.cell_edges), from.cell_edges, edges);
  to.edge_cells = shifted_rows_appended(std::move(to.edge_cells), from.edge_cells, cells);
  to.cell_faces = shifted_rows_appended(std::move(to.cell_faces), from.cell_faces, faces);
  to.edge_sheet_faces =
      shifted_rows_appended(std::move(to.edge_sheet_faces), from.edge_sheet_faces, faces);
  append_shifted(to.face_cell, from.face_cell, cells);
  append_shifted(to.face_twin, from.face_twin, faces);
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

IndexRows edges_of_points(const std::vector<Spring>& springs, std::size_t points) {
  IndexRows rows;
  rows.start.assign(points + 1, 0);
  for (const Spring& s : springs) ++rows.start[s.a + 1], ++rows.start[s.b + 1];
  for (std::size_t p = 0; p < points; ++p) rows.start[p + 1] += rows.start[p];
  rows.items.resize(rows.start.back());
  std::vector<std::int32_t> next(rows.start.begin(), rows.start.end() - 1);
  for (std::size_t e = 0; e < springs.size(); ++e) {
    rows.items[next[springs[e].a]++] = static_cast<std::int32_t>(e);
    rows.items[next[springs[e].b]++] = static_cast<std::int32_t>(e);
  }
  return rows;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_stiffness_per_mass(const PhysicalModel& model) {
  std::vector<double> ratios;
  for (EdgeId e : ids_of(model.geometry.edges)) {
    const Edge& edge = model.geometry.edges[e];
    const double mean_mass = 0.5 * (model.points[edge.a].mass + model.points[edge.b].mass);
    ratios.push_back(model.edges[e].stiffness / mean_mass);
  }
  return median(std::move(ratios));
}

// Step of semi-implicit Euler with springs K, stiffness-proportional damping and one contact a
// point: K <= K_springs + omega_c^2, C <= beta K_springs + 2 zeta_c omega_c (Weyl).
double largest_step(const PhysicalModel& model, double contact_frequency) {
  const double omega_springs = highest_frequency(model).omega_max;
  double damping_time = 0.0;  // s, largest c / k
  for (const EdgeAttributes& e : model.edges) {
    if (e.stiffness > 0.0) damping_time = std::max(damping_time, e.damping / e.stiffness);
  }
  const double zeta_contact = damping_ratio_of_restitution(model.object.restitution);
  const double squared = omega_springs * omega_springs + contact_frequency * contact_frequency;
  const double omega = std::sqrt(squared);
  const double damping = damping_time * omega_springs * omega_springs +
                         2.0 * zeta_contact * contact_frequency;  // 1/s
  return kStepSafety * stable_step(omega, omega > 0.0 ? damping / (2.0 * omega) : 0.0);
}

void append_points(Lattice& lattice, const PhysicalModel& model) {
  const auto object = static_cast<std::int32_t>(lattice.objects.size());
  for (PointId p : ids_of(model.points)) {
    lattice.motion.push_back({model.geometry.points[p], model.points[p].velocity});
    lattice.mass.push_back(model.points[p].mass);
    lattice.authored_position.push_back(model.geometry.points[p]);
  }
  lattice.force.resize(lattice.motion.size(), Vec3::Zero());
  lattice.role.resize(lattice.motion.size(), PointRole::kDynamic);
  lattice.contact_radius.resize(lattice.motion.size(), 0.0);
  lattice.point_object.resize(lattice.motion.size(), object);
  lattice.carrier.resize(lattice.motion.size(), 0);
  lattice.touched.resize(lattice.motion.size(), 0);
  lattice.peak_load.resize(lattice.motion.size(), 0.0);
}

void append_springs(Lattice& lattice, const PhysicalModel& model, std::int32_t first_point) {
  std::vector<double> shortest(model.points.size(), kUnbreakable);
  for (EdgeId e : ids_of(model.geometry.edges)) {
    const Edge& edge = model.geometry.edges[e];
    const EdgeAttributes& attributes = model.edges[e];
    lattice.springs.push_back({edge.a.value + first_point, edge.b.value + first_point,
                               attributes.stiffness, attributes.damping, attributes.rest_length,
                               attributes.break_threshold});
    for (PointId p : {edge.a, edge.b}) {
      shortest[p.index()] = std::min(shortest[p.index()], attributes.rest_length);
    }
  }
  for (std::size_t p = 0; p < shortest.size(); ++p) {
    if (shortest[p] < kUnbreakable) {
      lattice.contact_radius[first_point + p] = kContactRadiusShare * shortest[p];
    }
  }
}

template <class IdType>
IdRange<IdType> next_range(std::size_t first, std::size_t count) {
  return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(first + count)};
}

}  // namespace

std::size_t add_object(Lattice& lattice, PhysicalModel model) {
  require_valid(model);
  LatticeObject object;
  object.points = next_range<PointId>(lattice.motion.size(), model.points.size());
  object.edges = next_range<EdgeId>(lattice.springs.size(), model.edges.size());
  object.faces = next_range<FaceId>(lattice.topology.face_cell.size(), model.faces.size());
  object.cells = next_range<CellId>(lattice.breaking.cell_valid.size(), model.cells.size());
  object.contact_frequency = std::sqrt(kContactStiffnessShare * median_stiffness_per_mass(model));
  object.largest_step = largest_step(model, object.contact_frequency);

  const BreakingTopology topology = breaking_topology(model.geometry);
  const BreakingState state = breaking_state(model, topology);
  append_topology(lattice.topology, topology, object.edges.begin, object.cells.begin,
                  object.faces.begin);
  append(lattice.breaking.edge_broken, state.edge_broken);
  append(lattice.breaking.cell_valid, state.cell_valid);
  append(lattice.breaking.face_external, state.face_external);
  append_points(lattice, model);
  append_springs(lattice, model, object.points.begin);
  lattice.point_edges = edges_of_points(lattice.springs, lattice.motion.size());
  object.authored = std::move(model);
  lattice.objects.push_back(std::move(object));
  return lattice.objects.size() - 1;
}

void rebuild_active(Lattice& lattice) {
  lattice.active.clear();
  lattice.active_edge.clear();
  lattice.active_of_edge.assign(lattice.springs.size(), -1);
  for (std::size_t e = 0; e < lattice.springs.size(); ++e) {
    const Spring& s = lattice.springs[e];
    // A piece is dynamic as a whole, so that one end decides.
    if (lattice.breaking.edge_broken[e] || lattice.role[s.a] != PointRole::kDynamic) continue;
    lattice.active_of_edge[e] = static_cast<std::int32_t>(lattice.active.size());
    lattice.active.push_back(s);
    lattice.active_edge.push_back(static_cast<std::int32_t>(e));
  }
  lattice.dynamic_points.clear();
  lattice.carried_points.clear();
  for (std::size_t p = 0; p < lattice.role.size(); ++p) {
    const auto point = static_cast<std::int32_t>(p);
    if (lattice.role[p] == PointRole::kDynamic) lattice.dynamic_points.push_back(point);
    if (lattice.role[p] == PointRole::kCarried) lattice.carried_points.push_back(point);
  }
}

void slacken(Lattice& lattice, std::span<const std::int32_t> broken_edges) {
  for (std::int32_t e : broken_edges) {
    const std::int32_t active = lattice.active_of_edge[e];
    if (active < 0) continue;
    lattice.active[active].stiffness = 0.0;
    lattice.active[active].damping = 0.0;
    lattice.active[active].break_threshold = kUnbreakable;
  }
}

PhysicalModel extract_model(const Lattice& lattice, std::size_t index) {
  const LatticeObject& object = lattice.objects[index];
  PhysicalModel model = object.authored;
  for (PointId p : ids_of(model.points)) {
    const PointMotion& motion = lattice.motion[object.points.begin + p.index()];
    model.geometry.points[p] = motion.position;
    model.points[p].velocity = motion.velocity;
  }
  for (EdgeId e : ids_of(model.edges)) {
    model.edges[e].broken = lattice.breaking.edge_broken[object.edges.begin + e.index()] != 0;
  }
  for (CellId c : ids_of(model.cells)) {
    model.cells[c].valid = lattice.breaking.cell_valid[object.cells.begin + c.index()] != 0;
  }
  return model;
}

double elastic_energy(const Lattice& lattice, std::span<const std::int32_t> points) {
  double energy = 0.0;
  for (std::int32_t p : points) {
    for (std::int32_t e : lattice.point_edges[p]) {
      const Spring& s = lattice.springs[e];
      if (s.a != p || lattice.breaking.edge_broken[e]) continue;
      const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
      energy += spring_energy(s.stiffness, d.norm() - s.rest_length);
    }
  }
  return energy;
}

}  // namespace limber
