#include "core/dynamics/lattice.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/element_shares.h"
#include "core/dynamics/live_springs.h"
#include "core/dynamics/may_fold.h"
#include "core/dynamics/spring_force.h"
#include "core/dynamics/stable_step.h"
#include "core/model/bounds.h"
#include "core/model/median.h"
#include "core/model/point_edges.h"
#include "core/model/validate.h"

namespace limber {
namespace {

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
  for (const TwinFace& twin : from.face_twin) {
    const bool none = twin.face < 0;
    to.face_twin.push_back(none ? TwinFace{} : TwinFace{twin.face + faces, twin.cell + cells});
  }
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

// The links of the points just appended: linking all objects anew would cost the square of their
// number. After append_springs().
void append_point_links(Lattice& lattice, const GeometricModel& geometry,
                        const LatticeObject& object) {
  lattice.point_edges = shifted_rows_appended(std::move(lattice.point_edges), point_edges(geometry),
                                              object.edges.begin);
  for (std::int32_t p = object.points.begin; p < object.points.end; ++p) {
    for (std::int32_t e : lattice.point_edges[p]) {
      const Spring& s = lattice.springs[e];
      lattice.point_neighbours.push_back(s.a == p ? s.b : s.a);
    }
  }
}

double median_stiffness_per_mass(const PhysicalModel& model) {
  std::vector<double> ratios;
  for (EdgeId e : ids_of(model.geometry.edges)) {
    const Edge& edge = model.geometry.edges[e];
    const double mean_mass = 0.5 * (model.points[edge.a].mass + model.points[edge.b].mass);
    ratios.push_back(model.edges[e].stiffness / mean_mass);
  }
  return upper_median(std::move(ratios));
}

double median_rest_length(const PhysicalModel& model) {
  std::vector<double> lengths;
  for (const EdgeAttributes& e : model.edges) lengths.push_back(e.rest_length);
  return upper_median(std::move(lengths));
}

double largest_extent(const PhysicalModel& model) {
  return bounds_of(model.geometry.points).sizes().maxCoeff();
}

// omega_c^2 that bears columns of so many points, a spacing apart: 1/s^2, see kContactSinkShare.
double frequency_squared_to_stand(double points_in_column, double spacing) {
  return kStandardGravity * points_in_column / (kContactSinkShare * spacing);
}

// Grains have no shape to stand in: a cubic heap of them.
double contact_frequency_of_particles(const PhysicalModel& model) {
  if (model.object.particle_radius == 0.0) return 0.0;
  const double column = std::cbrt(static_cast<double>(model.points.size()));
  return std::sqrt(frequency_squared_to_stand(column, 2.0 * model.object.particle_radius));
}

// omega_c of the object's penalty contacts, rad/s.
double contact_frequency_of(const PhysicalModel& model) {
  if (model.edges.empty()) return contact_frequency_of_particles(model);
  const double spacing = median_rest_length(model);
  const double to_stand = frequency_squared_to_stand(largest_extent(model) / spacing, spacing);
  return std::sqrt(std::max(kContactStiffnessShare * median_stiffness_per_mass(model), to_stand));
}

double largest_damping_time(const PhysicalModel& model) {  // s, c / k
  double time = 0.0;
  for (const EdgeAttributes& e : model.edges) {
    if (e.stiffness > 0.0) time = std::max(time, e.damping / e.stiffness);
  }
  return time;
}

// Edges that damp without a spring, by Gershgorin's circles: C <= max_i 2 sum c / m_i, 1/s.
double pure_damping_rate(const PhysicalModel& model) {
  IdVector<PointId, double> damping(model.points.size(), 0.0);
  for (EdgeId e : ids_of(model.geometry.edges)) {
    if (model.edges[e].stiffness > 0.0) continue;
    damping[model.geometry.edges[e].a] += model.edges[e].damping;
    damping[model.geometry.edges[e].b] += model.edges[e].damping;
  }
  double rate = 0.0;
  for (PointId p : ids_of(model.points)) {
    rate = std::max(rate, 2.0 * damping[p] / model.points[p].mass);
  }
  return rate;
}

// Of the springs; without any, none.
double least_damping_time(const PhysicalModel& model) {  // s, c / k
  double time = kUnbreakable;
  for (const EdgeAttributes& e : model.edges) {
    if (carries(e)) time = std::min(time, e.damping / e.stiffness);
  }
  return time;
}

bool has_loose_points(const PhysicalModel& model) {
  const auto stiffness = stiffness_around(model);
  return std::find(stiffness.begin(), stiffness.end(), 0.0) != stiffness.end();
}

void set_step(LatticeObject& object, const PhysicalModel& model) {
  const bool folds = may_fold(model);
  object.contact_frequency = contact_frequency_of(model);
  object.has_loose_points = has_loose_points(model);
  object.spring_frequency =
      (folds ? large_strain_bound(model) : highest_frequency(model)).omega_max;
  const double damping_ratio = 0.5 * least_damping_time(model) * object.spring_frequency;
  object.step_strain = folds                                  ? kUnbreakable
                       : damping_ratio < kCalmingDampingRatio ? kSmallStrain
                                                              : kCalmStrain;
  object.spring_damping =
      largest_damping_time(model) * object.spring_frequency * object.spring_frequency +
      pure_damping_rate(model);
  object.least_mass = kUnbreakable;
  for (const PointAttributes& p : model.points) {
    object.least_mass = std::min(object.least_mass, p.mass);
  }
  object.largest_step = largest_step(object);
}

void append_points(Lattice& lattice, const PhysicalModel& model) {
  const auto object = static_cast<std::int32_t>(lattice.objects.size());
  for (PointId p : ids_of(model.points)) {
    const PointAttributes& point = model.points[p];
    const Vec3 velocity = point.pinned ? Vec3(Vec3::Zero()) : point.velocity;
    lattice.motion.push_back({model.geometry.points[p], velocity});
    lattice.mass.push_back(point.mass);
    lattice.inverse_mass.push_back(point.pinned ? 0.0 : 1.0 / point.mass);
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
                               attributes.break_threshold, attributes.crush_threshold});
    for (PointId p : {edge.a, edge.b}) {
      shortest[p.index()] = std::min(shortest[p.index()], attributes.rest_length);
    }
  }
  for (std::size_t p = 0; p < shortest.size(); ++p) {
    lattice.contact_radius[first_point + p] = shortest[p] < kUnbreakable
                                                  ? model.object.contact_share * shortest[p]
                                                  : model.object.particle_radius;
  }
}

std::vector<std::int32_t> points_of_role(const Lattice& lattice, PointRole role) {
  std::vector<std::int32_t> points;
  for (std::size_t p = 0; p < lattice.role.size(); ++p) {
    if (lattice.role[p] == role) points.push_back(static_cast<std::int32_t>(p));
  }
  return points;
}

void append_active(Lattice& lattice, bool breakable) {
  for (std::size_t e = 0; e < lattice.springs.size(); ++e) {
    const Spring& s = lattice.springs[e];
    // A piece is dynamic as a whole, so that one end decides.
    if (lattice.breaking.edge_broken[e] || lattice.role[s.a] != PointRole::kDynamic) continue;
    if (s.breakable() != breakable) continue;
    lattice.active_of_edge[e] = static_cast<std::int32_t>(lattice.active.size());
    lattice.active.push_back(s);
    lattice.active_edge.push_back(static_cast<std::int32_t>(e));
  }
}

// Of modes of this stiffness over mass (1/s^2) and damping rate (1/s), with its safety.
double safe_step(double omega_squared, double rate) {
  // Dampers alone: v' = (1 - C dt) v is stable to C dt = 2.
  if (omega_squared == 0.0) return rate > 0.0 ? kStepSafety * 2.0 / rate : stable_step(0.0, 0.0);
  const double omega = std::sqrt(omega_squared);
  return kStepSafety * stable_step(omega, rate / (2.0 * omega));
}

double square(double x) { return x * x; }

template <class IdType>
IdRange<IdType> next_range(std::size_t first, std::size_t count) {
  return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(first + count)};
}

// Faces of a closed cell run along each side of theirs both ways, those of a flat one do not.
bool is_closed(const GeometricModel& geometry, const Cell& cell) {
  std::vector<std::array<std::int32_t, 2>> sides;
  for (FaceId f : cell.faces) {
    const auto& c = geometry.faces[f].corners;
    for (int i = 0; i < 3; ++i) sides.push_back({c[i].value, c[(i + 1) % 3].value});
  }
  return std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
    return std::find(sides.begin(), sides.end(), std::array{side[1], side[0]}) != sides.end();
  });
}

void append_faces(Lattice& lattice, const GeometricModel& geometry, std::int32_t first_point) {
  std::vector<std::uint8_t> closed;
  for (const Cell& cell : geometry.cells) closed.push_back(is_closed(geometry, cell));
  for (const Face& face : geometry.faces) {
    const auto& [a, b, c] = face.corners;
    lattice.face_corners.push_back(
        {first_point + a.value, first_point + b.value, first_point + c.value});
    lattice.face_two_sided.push_back(!face.cell.valid() || !closed[face.cell.index()]);
  }
}

}  // namespace

bool joined(const Lattice& lattice, std::int32_t p, std::int32_t q) {
  for (std::int32_t i = lattice.point_edges.start[p]; i < lattice.point_edges.start[p + 1]; ++i) {
    if (lattice.point_neighbours[i] != q) continue;
    if (!lattice.breaking.edge_broken[lattice.point_edges.items[i]]) return true;
  }
  return false;
}

double length_of(const Lattice& lattice, std::int32_t edge) {
  const Spring& s = lattice.springs[edge];
  return (lattice.motion[s.b].position - lattice.motion[s.a].position).norm();
}

bool is_overstretched(const Lattice& lattice, std::int32_t edge) {
  const Spring& s = lattice.springs[edge];
  const double stretch = length_of(lattice, edge) - s.rest_length;
  return stretch > s.break_threshold || -stretch > s.crush_threshold;
}

std::size_t add_object(Lattice& lattice, PhysicalModel model) {
  require_valid(model);
  LatticeObject object;
  object.points = next_range<PointId>(lattice.motion.size(), model.points.size());
  object.edges = next_range<EdgeId>(lattice.springs.size(), model.edges.size());
  object.faces = next_range<FaceId>(lattice.topology.face_cell.size(), model.faces.size());
  object.cells = next_range<CellId>(lattice.breaking.cell_valid.size(), model.cells.size());
  set_step(object, model);

  const BreakingTopology topology = breaking_topology(model.geometry);
  const BreakingState state = breaking_state(model, topology);
  append_topology(lattice.topology, topology, object.edges.begin, object.cells.begin,
                  object.faces.begin);
  append(lattice.breaking.edge_broken, state.edge_broken);
  append(lattice.breaking.valid_cells, state.valid_cells);
  append(lattice.breaking.cell_valid, state.cell_valid);
  append(lattice.breaking.face_external, state.face_external);
  append_points(lattice, model);
  append_faces(lattice, model.geometry, object.points.begin);
  append_springs(lattice, model, object.points.begin);
  append_point_links(lattice, model.geometry, object);
  object.authored = std::move(model);
  lattice.objects.push_back(std::move(object));
  return lattice.objects.size() - 1;
}

void retire_object(Lattice& lattice, std::size_t index) {
  LatticeObject& object = lattice.objects[index];
  for (std::int32_t p = object.points.begin; p < object.points.end; ++p) {
    lattice.role[p] = PointRole::kIdle;
    lattice.motion[p].velocity.setZero();
  }
  PhysicalModel left;
  left.name = std::move(object.authored.name);
  left.object = object.authored.object;
  object.authored = std::move(left);
}

// K <= K_springs + omega_c^2 + k / m (Weyl; a contact of points of one mass is omega_c^2 m / 2 on
// both), C <= beta K_springs + c / m.
double largest_step(const LatticeObject& object, double stiffness, double damping,
                    LargestStrain strain) {
  const double gain = strain == LargestStrain::kAny ? square(kMostGainByTurning) : 1.0;
  const double springs = gain * square(object.spring_frequency);
  const double contact = square(object.contact_frequency);
  return safe_step(
      std::max(springs + contact, kContactsOfAGrain * contact) + stiffness / object.least_mass,
      gain * object.spring_damping + damping / object.least_mass);
}

// Stiff springs move the points as one: omega_c is the frequency of the whole on all its contacts.
double largest_contact_step(const LatticeObject& object) {
  const double contacts = object.has_loose_points ? kContactsOfAGrain : 1.0;
  return safe_step(contacts * square(object.contact_frequency), 0.0);
}

bool is_strained(const Lattice& lattice, std::size_t index) {
  const LatticeObject& object = lattice.objects[index];
  if (std::isinf(object.step_strain)) return false;
  for (std::int32_t e = object.edges.begin; e < object.edges.end; ++e) {
    const std::int32_t active = lattice.active_of_edge[e];
    if (active < 0 || lattice.active[active].stiffness == 0.0) continue;
    const Spring& s = lattice.active[active];
    const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
    const Vec3 w = lattice.motion[s.b].velocity - lattice.motion[s.a].velocity;
    const double most = object.step_strain * s.rest_length;
    if (std::abs(d.norm() - s.rest_length) > most) return true;
    if (std::abs(w.dot(d)) > most * object.spring_frequency * d.norm()) return true;
  }
  return false;
}

void rebuild_active(Lattice& lattice) {
  lattice.active.clear();
  lattice.active_edge.clear();
  lattice.active_of_edge.assign(lattice.springs.size(), -1);
  append_active(lattice, false);
  lattice.first_breakable = lattice.active.size();
  append_active(lattice, true);
  lattice.dynamic_points = points_of_role(lattice, PointRole::kDynamic);
  rebuild_carried(lattice);
}

void rebuild_carried(Lattice& lattice) {
  lattice.carried_points = points_of_role(lattice, PointRole::kCarried);
}

void slacken(Lattice& lattice, std::span<const std::int32_t> broken_edges) {
  for (std::int32_t e : broken_edges) {
    const std::int32_t active = lattice.active_of_edge[e];
    if (active < 0) continue;
    lattice.active[active].stiffness = 0.0;
    lattice.active[active].damping = 0.0;
    lattice.active[active].break_threshold = kUnbreakable;
    lattice.active[active].crush_threshold = kUnbreakable;
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
  for_each_live_spring(lattice, points, [&](const Spring& s) {
    energy += spring_energy(s.stiffness, stretch_of(lattice, s));
  });
  return energy;
}

}  // namespace limber
