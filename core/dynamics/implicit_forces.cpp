#include "core/dynamics/implicit_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/spring_force.h"

namespace limber {
namespace {

SpringStretch state_of(const Lattice& lattice, const Spring& s) {
  const PointMotion &a = lattice.motion[s.a], &b = lattice.motion[s.b];
  return spring_stretch(b.position - a.position, b.velocity - a.velocity, s.rest_length);
}

// Pulls both ends of a spring together.
void add_pull(const ImplicitSystem& system, const Spring& s, const Vec3& pull,
              Eigen::VectorXd& sum) {
  if (system.row(s.a) >= 0) sum.segment<3>(3 * system.row(s.a)) += pull;
  if (system.row(s.b) >= 0) sum.segment<3>(3 * system.row(s.b)) -= pull;
}

}  // namespace

ImplicitForces::ImplicitForces(const Lattice& lattice, const ImplicitSystem& system,
                               std::span<const PointSupport> supports)
    : system_(system), constant_(system.size()), first_(motion_of(lattice, system)) {
  for (std::size_t row = 0; row < first_.size(); ++row) {
    constant_.segment<3>(3 * row) = lattice.force[system_.points()[row]];
  }
  for (std::int32_t i : system_.springs()) {
    const Spring& s = lattice.active[i];
    const SpringStretch state = state_of(lattice, s);
    const double tension = spring_tension(s.stiffness, s.damping, state.stretch, state.rate);
    add_pull(system_, s, -tension * state.direction, constant_);
  }
  for (const PointSupport& s : supports) {
    if (system_.row(s.point) >= 0) supports_.push_back(s);
  }
}

void ImplicitForces::start_step(const Lattice& lattice, double dt) {
  dt_ = dt;
  start_ = motion_of(lattice, system_);
  lengths_.clear();
  for (std::int32_t i : system_.springs()) {
    const Spring& s = lattice.active[i];
    lengths_.push_back((lattice.motion[s.b].position - lattice.motion[s.a].position).norm());
  }
}

Eigen::VectorXd ImplicitForces::remaining_impulse(const Lattice& lattice) const {
  Eigen::VectorXd impulse = dt_ * constant_;
  add_supports(lattice, impulse);
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    const Spring& s = lattice.active[system_.springs()[i]];
    const SpringStretch state = state_of(lattice, s);
    const double tension = step_spring(s, dt_, lengths_[i]).tension(state.stretch + s.rest_length);
    add_pull(system_, s, dt_ * tension * state.direction, impulse);
  }
  for (std::size_t row = 0; row < start_.size(); ++row) {
    const std::int32_t p = system_.points()[row];
    impulse.segment<3>(3 * row) +=
        lattice.mass[p] * (start_[row].velocity - lattice.motion[p].velocity);
  }
  return impulse;
}

double ImplicitForces::merit(const Lattice& lattice) const {
  double sum = outside(lattice);
  for (std::size_t i = 0; i < lengths_.size(); ++i) {
    const Spring& s = lattice.active[system_.springs()[i]];
    const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
    sum += step_spring(s, dt_, lengths_[i]).potential(d.norm());
  }
  for (const PointSupport& s : supports_) {
    const Vec3& first = first_[system_.row(s.point)].velocity;
    const double change = s.normal.dot(lattice.motion[s.point].velocity - first);
    sum += 0.5 * dt_ * s.damping * change * change;
  }
  for (std::size_t row = 0; row < start_.size(); ++row) {
    const std::int32_t p = system_.points()[row];
    const Vec3 change = lattice.motion[p].velocity - start_[row].velocity;
    sum += 0.5 * lattice.mass[p] * change.dot(change);
  }
  return sum;
}

void ImplicitForces::add_supports(const Lattice& lattice, Eigen::VectorXd& impulse) const {
  for (const PointSupport& s : supports_) {
    const std::int32_t row = system_.row(s.point);
    const Vec3 change = lattice.motion[s.point].velocity - first_[row].velocity;
    const double push =
        s.stiffness * s.normal.dot(moved(lattice, row)) + s.damping * s.normal.dot(change);
    impulse.segment<3>(3 * row) -= dt_ * push * s.normal;
  }
}

StepEnergy ImplicitForces::energy(const Lattice& lattice) const {
  StepEnergy energy;
  add_kinetic(lattice, energy);
  add_elastic(lattice, energy);
  energy.outside = outside(lattice);
  return energy;
}

Vec3 ImplicitForces::moved(const Lattice& lattice, std::int32_t row) const {
  return lattice.motion[system_.points()[row]].position - first_[row].position;
}

double ImplicitForces::outside(const Lattice& lattice) const {
  double sum = 0.0;
  for (std::size_t row = 0; row < first_.size(); ++row) {
    const auto i = static_cast<std::int32_t>(row);
    sum -= constant_.segment<3>(3 * i).dot(moved(lattice, i));
  }
  for (const PointSupport& s : supports_) {
    sum += spring_energy(s.stiffness, s.normal.dot(moved(lattice, system_.row(s.point))));
  }
  return sum;
}

void ImplicitForces::add_kinetic(const Lattice& lattice, StepEnergy& energy) const {
  double mass = 0.0;
  Vec3 momentum = Vec3::Zero();
  for (std::int32_t p : system_.points()) {
    mass += lattice.mass[p];
    momentum += lattice.mass[p] * lattice.motion[p].velocity;
  }
  const Vec3 mean = momentum / mass;
  for (std::int32_t p : system_.points()) {
    const Vec3 w = lattice.motion[p].velocity - mean;
    energy.kinetic += 0.5 * lattice.mass[p] * w.dot(w);
  }
  energy.drift = 0.5 * mass * mean.dot(mean);
}

void ImplicitForces::add_elastic(const Lattice& lattice, StepEnergy& energy) const {
  double coordinate = 0.0, stiffness = 0.0;
  for (std::int32_t i : system_.springs()) {
    const Spring& s = lattice.active[i];
    energy.elastic += spring_energy(s.stiffness, state_of(lattice, s).stretch);
    coordinate = std::max(coordinate, lattice.motion[s.a].position.lpNorm<Eigen::Infinity>());
    stiffness += s.stiffness;
  }
  const double digit = std::numeric_limits<double>::epsilon() * coordinate;
  energy.rounding = spring_energy(stiffness, 4.0 * digit);
}

std::vector<PointMotion> motion_of(const Lattice& lattice, const ImplicitSystem& system) {
  std::vector<PointMotion> motion;
  motion.reserve(system.points().size());
  for (std::int32_t p : system.points()) motion.push_back(lattice.motion[p]);
  return motion;
}

}  // namespace limber
