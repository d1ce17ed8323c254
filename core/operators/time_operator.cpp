#include "core/operators/time_operator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/dynamics/internal_damping.h"
#include "core/model/diagnostic_list.h"
#include "core/model/errors.h"
#include "core/threads/parallel_for.h"

namespace limber {
namespace {

// Substeps between two looks at the list of point contacts. In four substeps of a ceramic, 0.1 ms,
// a fragment at 5 m/s moves half a millimetre, less than the list's skin and less than the tenth of
// an edge that lies between a broken edge and contact.
constexpr int kContactRefreshInterval = 4;

// Of a parallel loop that does a few operations a point: some 20 microseconds.
constexpr std::size_t kPointsPerRange = 8192;

template <class Body>
void for_points(std::span<const std::int32_t> points, const Body& body) {
  parallel_for(points.size(), kPointsPerRange, [&](std::size_t from, std::size_t to) {
    for (std::int32_t p : points.subspan(from, to - from)) body(p);
  });
}

double shortest_edge(const LatticeObject& object) {  // m
  double shortest = kUnbreakable;
  for (const EdgeAttributes& e : object.authored.edges) {
    shortest = std::min(shortest, e.rest_length);
  }
  return shortest;
}

}  // namespace

double TimeOperator::largest_step_of(std::size_t index, const Environment& environment) const {
  const LatticeObject& object = lattice_.objects[index];
  if (is_implicit(index)) return largest_contact_step(object);
  const bool penalty = environment.ground && std::isfinite(environment.ground->stiffness);
  const double stiffness = penalty ? environment.ground->stiffness : 0.0;
  const double damping = penalty ? environment.ground->damping : 0.0;
  const bool strained = is_strained(lattice_, index);
  return limber::largest_step(object, stiffness, damping,
                              strained ? LargestStrain::kAny : LargestStrain::kSmall);
}

std::optional<std::size_t> TimeOperator::hardest_object(const Environment& environment) const {
  std::vector<bool> dynamic(lattice_.objects.size(), false);
  for (std::int32_t p : lattice_.dynamic_points) dynamic[lattice_.point_object[p]] = true;
  std::optional<std::size_t> hardest;
  double least = kUnbreakable;
  for (std::size_t o = 0; o < lattice_.objects.size(); ++o) {
    const double step = dynamic[o] ? largest_step_of(o, environment) : kUnbreakable;
    if (step >= least) continue;
    least = step;
    hardest = o;
  }
  return hardest;
}

double TimeOperator::largest_step(const Environment& environment) const {
  const std::optional<std::size_t> hardest = hardest_object(environment);
  return hardest ? largest_step_of(*hardest, environment) : kUnbreakable;
}

void TimeOperator::make_implicit(std::size_t object) {
  if (!is_symplectic()) {
    throw InputError({"time operator", "one object is to be implicit beside a Runge-Kutta method",
                      "use symplectic Euler for the others"});
  }
  implicit_.add(object);
  lattice_.objects[object].implicit = true;
  springs_.keep_in_double(object);
}

bool TimeOperator::is_implicit(std::size_t object) const {
  return integrator_ == Integrator::kImplicitEuler || implicit_.contains(object);
}

void TimeOperator::require_sound_step(double dt, const Environment& environment,
                                      const SubstepCoupling* coupling) const {
  require_valid(environment);
  if (!(dt > 0.0 && std::isfinite(dt))) {
    throw InputError({"time operator", "the step is " + std::to_string(dt) + " s",
                      "give a finite step above 0"});
  }
  if (!is_symplectic() && coupling && !lattice_.carried_points.empty()) {
    throw InputError({"time operator", "points are carried by bodies in a Runge-Kutta step",
                      "use symplectic Euler where lattices touch bodies that carry points"});
  }
}

void TimeOperator::roles_changed() {
  springs_.active_changed();
  implicit_.roles_changed();
  pieces_stale_ = true;
  contacts_stale_ = true;
  faces_stale_ = true;
  slack_ = 0;
}

TimeOperator::LatticeContacts TimeOperator::put_contacts_aside() {
  return std::exchange(contacts_, {});
}

void TimeOperator::take_contacts_back(LatticeContacts aside) {
  aside.points.take_over(std::move(contacts_.points));
  aside.cells.take_over(std::move(contacts_.cells));
  aside.faces.take_over(std::move(contacts_.faces), lattice_);
  contacts_ = std::move(aside);
}

const Components& TimeOperator::pieces() {
  if (pieces_stale_) pieces_.reset(lattice_);
  pieces_stale_ = false;
  return pieces_.components();
}

StepReport TimeOperator::advance(int substeps, double dt, const Environment& environment,
                                 SubstepCoupling* coupling) {
  require_sound_step(dt, environment, coupling);
  make_all_implicit();
  StepReport report;
  const double start = time_;
  if (environment.ground) ground_.stop_what_enters(lattice_, *environment.ground, report.ground);
  for (int n = 0; n < substeps; ++n) {
    if (n % kContactRefreshInterval == 0) refresh_contacts();
    refresh_faces(environment);
    if (is_symplectic()) {
      step_symplectic(environment, dt, coupling);
    } else {
      const bool fourth_order = integrator_ == Integrator::kRungeKutta4;
      step_runge_kutta(fourth_order ? kRungeKutta4Tableau : kExplicitEulerTableau, environment, dt,
                       coupling);
    }
    if (environment.ground) {
      const double moved_share = is_symplectic() ? 1.0 : 0.5;
      ground_.finish_step(lattice_, *environment.ground, dt, moved_share, report.ground);
    }
    if (coupling) coupling->advance(lattice_, dt);
    report.spring_updates += lattice_.active.size() - slack_;
    if (!springs_.overstretched_edges().empty()) break_overstretched(report);
    time_ = start + (n + 1) * dt;
    if (n % kDampingInterval == kDampingInterval - 1 || n == substeps - 1) {
      if (watches_load_) sample_load();
      const int since = n % kDampingInterval + 1;
      report.damped_J += damp_internally(lattice_, pieces(), since * dt, leads(dt));
    }
  }
  require_finite();
  return report;
}

std::uint64_t TimeOperator::advance_springs_only(int substeps, double dt) {
  make_all_implicit();
  supports_ = {};
  for (int n = 0; n < substeps; ++n) {
    apply_gravity(Vec3::Zero());
    springs_.add(dt);
    integrate(dt);
  }
  return lattice_.active.size() * static_cast<std::uint64_t>(substeps);
}

std::vector<double> TimeOperator::leads(double dt) const {
  std::vector<double> leads(lattice_.objects.size(), 0.0);
  for (std::size_t o = 0; o < leads.size(); ++o) {
    if (is_symplectic() && !is_implicit(o)) leads[o] = 0.5 * dt;
  }
  return leads;
}

void TimeOperator::refresh_contacts() {
  contacts_.points.refresh(lattice_, pieces(), contacts_stale_, carried_stale_);
  contacts_.faces.refresh(lattice_, pieces(), contacts_stale_, carried_stale_);
  contacts_.cells.refresh(lattice_, contacts_stale_);
  contacts_stale_ = carried_stale_ = false;
}

void TimeOperator::refresh_faces(const Environment& environment) {
  if (!environment.air || !faces_stale_) return;
  faces_ = faces_in_air(lattice_, PointRole::kDynamic);
  faces_stale_ = false;
}

void TimeOperator::apply_gravity(const Vec3& gravity) {
  for_points(lattice_.dynamic_points,
             [&](std::int32_t p) { lattice_.force[p] = lattice_.mass[p] * gravity; });
  for (std::int32_t p : lattice_.carried_points) lattice_.force[p].setZero();
}

void TimeOperator::sum_forces(const Environment& environment, double time, double dt,
                              double weight) {
  summed_at_ = time;
  apply_gravity(environment.gravity);
  springs_.add(dt);
  if (environment.air) {
    add_face_forces(faces_, *environment.air, time, lattice_.motion, lattice_.force);
  }
  for (std::size_t i = 0; i < coupling_force_.size(); ++i) {
    lattice_.force[lattice_.dynamic_points[i]] += coupling_force_[i];
  }
  // Contacts go by all the others.
  if (is_symplectic()) {
    contacts_.points.bear(lattice_, dt);
  } else {
    contacts_.points.add_forces(lattice_);
  }
  contacts_.cells.add_forces(lattice_, dt);
  contacts_.faces.add_forces(lattice_, dt);
  supports_ = {};
  if (!environment.ground) return;
  ground_.add_forces(lattice_, *environment.ground, implicit_.explicit_points(lattice_), weight);
  supports_ =
      ground_.support(lattice_, *environment.ground, implicit_.implicit_points(lattice_), dt);
}

void TimeOperator::step_symplectic(const Environment& environment, double dt,
                                   SubstepCoupling* coupling) {
  sum_forces(environment, time_, dt, 1.0);
  if (coupling) coupling->add_forces(lattice_, dt);
  integrate(dt);
}

void TimeOperator::integrate(double dt) {
  for_points(implicit_.explicit_points(lattice_), [&](std::int32_t p) {
    PointMotion& motion = lattice_.motion[p];
    motion.velocity += lattice_.force[p] * (dt * lattice_.inverse_mass[p]);
    motion.position += motion.velocity * dt;
  });
  implicit_.step(lattice_, dt, supports_);
}

// Of an implicit operator. Objects may have been added.
void TimeOperator::make_all_implicit() {
  if (integrator_ != Integrator::kImplicitEuler) return;
  for (std::size_t o = 0; o < lattice_.objects.size(); ++o) {
    if (!implicit_.contains(o)) implicit_.add(o);
    lattice_.objects[o].implicit = true;
  }
}

void TimeOperator::step_runge_kutta(const ButcherTableau& tableau, const Environment& environment,
                                    double dt, SubstepCoupling* coupling) {
  const std::size_t count = lattice_.dynamic_points.size();
  evaluate_coupling(environment.gravity, dt, coupling);
  start_.resize(count);
  slopes_.resize(count * tableau.stages);
  for (std::size_t i = 0; i < count; ++i) start_[i] = lattice_.motion[lattice_.dynamic_points[i]];
  for (int stage = 0; stage < tableau.stages; ++stage) {
    move_to_stage(tableau, stage, dt);
    sum_forces(environment, time_ + tableau.c[stage] * dt, dt, tableau.b[stage]);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t p = lattice_.dynamic_points[i];
      slopes_[stage * count + i] = {lattice_.motion[p].velocity,
                                    lattice_.force[p] * lattice_.inverse_mass[p]};
    }
  }
  complete_stages(tableau, dt);
  coupling_force_.clear();
}

void TimeOperator::evaluate_coupling(const Vec3& gravity, double dt, SubstepCoupling* coupling) {
  if (!coupling) return;
  apply_gravity(gravity);
  springs_.add(dt);  // contacts go by the other forces
  for (std::int32_t p : lattice_.dynamic_points) coupling_force_.push_back(-lattice_.force[p]);
  coupling->add_forces(lattice_, dt);
  for (std::size_t i = 0; i < coupling_force_.size(); ++i) {
    coupling_force_[i] += lattice_.force[lattice_.dynamic_points[i]];
  }
}

void TimeOperator::move_to_stage(const ButcherTableau& tableau, int stage, double dt) {
  const std::size_t count = start_.size();
  for (std::size_t i = 0; i < count; ++i) {
    PointMotion motion = start_[i];
    for (int j = 0; j < stage; ++j) {
      const PointMotion& slope = slopes_[j * count + i];
      motion.position += dt * tableau.a[stage][j] * slope.position;
      motion.velocity += dt * tableau.a[stage][j] * slope.velocity;
    }
    lattice_.motion[lattice_.dynamic_points[i]] = motion;
  }
}

void TimeOperator::complete_stages(const ButcherTableau& tableau, double dt) {
  const std::size_t count = start_.size();
  for (std::size_t i = 0; i < count; ++i) {
    PointMotion motion = start_[i];
    for (int stage = 0; stage < tableau.stages; ++stage) {
      const PointMotion& slope = slopes_[stage * count + i];
      motion.position += dt * tableau.b[stage] * slope.position;
      motion.velocity += dt * tableau.b[stage] * slope.velocity;
    }
    lattice_.motion[lattice_.dynamic_points[i]] = motion;
  }
}

void TimeOperator::break_overstretched(StepReport& report) {
  const std::span<const std::int32_t> edges = springs_.overstretched_edges();
  pieces();  // as they were
  const std::size_t first = report.breaks.size();
  for (std::int32_t e : edges) report.breaks.push_back(event_of(e));
  break_edges(lattice_.topology, lattice_.breaking, edges, broken_);
  slacken(lattice_, broken_.broken_edges);
  springs_.remove(broken_.broken_edges);
  implicit_.edges_broken(lattice_, broken_.broken_edges);
  slack_ += broken_.broken_edges.size();
  report.broken_edges += broken_.broken_edges.size();
  if (boundary_) boundary_->update(lattice_.topology, broken_);
  const auto splits = pieces_.edges_broken(lattice_, broken_.broken_edges);
  for (const auto& split : splits) report.splits.push_back({summed_at_, split.from, split.to});
  for (std::size_t i = first; i < report.breaks.size(); ++i) {
    BreakEvent& event = report.breaks[i];
    event.piece = pieces_.components().label[lattice_.springs[event.edge].a];
  }
  contacts_.points.edges_broken(lattice_, broken_.broken_edges);
  contacts_.faces.edges_broken();
  contacts_stale_ = contacts_stale_ || !splits.empty();
  faces_stale_ = true;
}

// Before the edge breaks: its cells are still valid.
BreakEvent TimeOperator::event_of(std::int32_t edge) const {
  const Spring& s = lattice_.springs[edge];
  BreakEvent event;
  event.time = summed_at_;
  event.edge = edge;
  event.object = lattice_.point_object[s.a];
  event.where = 0.5 * (lattice_.motion[s.a].position + lattice_.motion[s.b].position);
  for (std::int32_t cell : lattice_.topology.edge_cells[edge]) {
    if (event.cell < 0 && lattice_.breaking.cell_valid[cell]) event.cell = cell;
  }
  return event;
}

void TimeOperator::sample_load() {
  for (std::size_t i = lattice_.first_breakable; i < lattice_.active.size(); ++i) {
    const Spring& s = lattice_.active[i];
    const Vec3 d = lattice_.motion[s.b].position - lattice_.motion[s.a].position;
    const double stretch = d.norm() - s.rest_length;
    const double load = std::max(stretch / s.break_threshold, -stretch / s.crush_threshold);
    lattice_.peak_load[s.a] = std::max(lattice_.peak_load[s.a], load);
  }
}

void TimeOperator::require_finite() const {
  for (std::int32_t p : lattice_.dynamic_points) {
    const PointMotion& motion = lattice_.motion[p];
    if (!motion.position.allFinite() || !motion.velocity.allFinite()) throw blown_up(p);
  }
}

// Too large a step, or places so far out that neighbours cannot be told apart.
SimulationError TimeOperator::blown_up(std::int32_t point) const {
  constexpr double kLeastPlaces = 1e4;  // along the shortest edge
  const LatticeObject& object = lattice_.objects[lattice_.point_object[point]];
  const std::string where =
      object.authored.name + ": point " + std::to_string(point - object.points.begin);
  const std::string what = "its position or velocity is no longer finite";
  const double distance = lattice_.authored_position[point].norm();
  const double apart = distance * std::numeric_limits<double>::epsilon();
  if (kLeastPlaces * apart < shortest_edge(object)) {
    return SimulationError(
        {where, what, "use a smaller step (step scale below 1) or softer springs"});
  }
  return SimulationError({where,
                          what + say("; it started ", distance,
                                     " m from the origin, where places are ", apart, " m apart"),
                          "move the scene to the origin"});
}

}  // namespace limber
