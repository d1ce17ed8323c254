#include "core/operators/time_operator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/dynamics/internal_damping.h"
#include "core/dynamics/spring_force.h"
#include "core/model/errors.h"

namespace limber {
namespace {

// Substeps between two looks at the list of point contacts. In four substeps of a ceramic, 0.1 ms,
// a fragment at 5 m/s moves half a millimetre, less than the list's skin and less than the tenth of
// an edge that lies between a broken edge and contact.
constexpr int kContactRefreshInterval = 4;

}  // namespace

double TimeOperator::largest_step() const {
  std::vector<bool> dynamic(lattice_.objects.size(), false);
  for (std::int32_t p : lattice_.dynamic_points) dynamic[lattice_.point_object[p]] = true;
  double step = kUnbreakable;
  for (std::size_t o = 0; o < lattice_.objects.size(); ++o) {
    if (dynamic[o]) step = std::min(step, lattice_.objects[o].largest_step);
  }
  return step;
}

void TimeOperator::roles_changed() {
  pieces_stale_ = true;
  contacts_stale_ = true;
  slack_ = 0;
}

const Components& TimeOperator::pieces() {
  if (pieces_stale_) pieces_ = components(lattice_);
  pieces_stale_ = false;
  return pieces_;
}

StepReport TimeOperator::advance(int substeps, double dt, const Vec3& gravity_m_s2,
                                 SubstepCoupling* coupling) {
  StepReport report;
  for (int n = 0; n < substeps; ++n) {
    if (n % kContactRefreshInterval == 0) refresh_contacts();
    apply_gravity(gravity_m_s2);
    apply_springs();
    contacts_.add_forces(lattice_);
    if (coupling) coupling->add_forces(lattice_, dt);
    integrate(dt);
    if (coupling) coupling->advance(lattice_, dt);
    report.spring_updates += lattice_.active.size() - slack_;
    if (!overstretched_.empty()) break_overstretched(n * dt, report);
    if (n % kDampingInterval == kDampingInterval - 1 || n == substeps - 1) {
      sample_load();
      const int since = n % kDampingInterval + 1;
      report.damped_J += damp_internally(lattice_, pieces(), since * dt);
    }
  }
  require_finite();
  return report;
}

std::uint64_t TimeOperator::advance_springs_only(int substeps, double dt) {
  for (int n = 0; n < substeps; ++n) {
    apply_gravity(Vec3::Zero());
    apply_springs();
    integrate(dt);
  }
  return lattice_.active.size() * static_cast<std::uint64_t>(substeps);
}

void TimeOperator::refresh_contacts() {
  contacts_.refresh(lattice_, pieces(), contacts_stale_, carried_stale_);
  contacts_stale_ = carried_stale_ = false;
}

void TimeOperator::apply_gravity(const Vec3& gravity) {
  for (std::int32_t p : lattice_.dynamic_points) lattice_.force[p] = lattice_.mass[p] * gravity;
  for (std::int32_t p : lattice_.carried_points) lattice_.force[p].setZero();
}

void TimeOperator::apply_springs() {
  overstretched_.clear();
  const std::size_t count = lattice_.active.size();
  const Spring* springs = lattice_.active.data();
  const PointMotion* motion = lattice_.motion.data();
  Vec3* force = lattice_.force.data();
  for (std::size_t i = 0; i < count; ++i) {
    const Spring& s = springs[i];
    const SpringStretch state =
        spring_stretch(motion[s.b].position - motion[s.a].position,
                       motion[s.b].velocity - motion[s.a].velocity, s.rest_length);
    const Vec3 pull =
        spring_tension(s.stiffness, s.damping, state.stretch, state.rate) * state.direction;
    force[s.a] += pull;
    force[s.b] -= pull;
    if (state.stretch > s.break_threshold) {
      overstretched_.push_back(static_cast<std::int32_t>(i));
    }
  }
}

void TimeOperator::integrate(double dt) {
  for (std::int32_t p : lattice_.dynamic_points) {
    PointMotion& motion = lattice_.motion[p];
    motion.velocity += lattice_.force[p] * (dt / lattice_.mass[p]);
    motion.position += motion.velocity * dt;
  }
}

void TimeOperator::break_overstretched(double time, StepReport& report) {
  std::vector<std::int32_t> edges;
  for (std::int32_t i : overstretched_) {
    const Spring& s = lattice_.active[i];
    edges.push_back(lattice_.active_edge[i]);
    const Vec3 middle = 0.5 * (lattice_.motion[s.a].position + lattice_.motion[s.b].position);
    report.breaks.push_back({time, edges.back(), middle});
  }
  const BreakingResult result = break_edges(lattice_.topology, lattice_.breaking, edges);
  slacken(lattice_, result.broken_edges);
  slack_ += result.broken_edges.size();
  report.broken_edges += result.broken_edges.size();
  pieces_stale_ = true;
  contacts_stale_ = true;
}

void TimeOperator::sample_load() {
  for (const Spring& s : lattice_.active) {
    if (s.break_threshold == kUnbreakable) continue;
    const Vec3 d = lattice_.motion[s.b].position - lattice_.motion[s.a].position;
    const double load = (d.norm() - s.rest_length) / s.break_threshold;
    lattice_.peak_load[s.a] = std::max(lattice_.peak_load[s.a], load);
  }
}

void TimeOperator::require_finite() const {
  for (std::int32_t p : lattice_.dynamic_points) {
    const PointMotion& motion = lattice_.motion[p];
    if (motion.position.allFinite() && motion.velocity.allFinite()) continue;
    const LatticeObject& object = lattice_.objects[lattice_.point_object[p]];
    throw SimulationError(
        {object.authored.name + ": point " + std::to_string(p - object.points.begin),
         "its position or velocity is no longer finite",
         "use a smaller step (step scale below 1) or softer springs"});
  }
}

}  // namespace limber
