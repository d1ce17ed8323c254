#include "core/dynamics/implicit_system.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/spring_force.h"

namespace limber {
namespace {

constexpr std::int32_t kNoRow = -1;

// dt^2 (across I + (along - across) n n^T), without its rows.
Coupling coupling_of(const LinkTangent& tangent, double dt) {
  Coupling coupling;
  coupling.across = dt * dt * tangent.across;
  coupling.root = dt * std::sqrt(tangent.along - tangent.across) * tangent.direction;
  return coupling;
}

Vec3 part(const Eigen::VectorXd& x, std::int32_t row) { return x.segment<3>(3 * row); }

}  // namespace

double StepSpring::potential(double length) const {
  return spring_energy(stiffness, length - rest_length) +
         spring_energy(damper_stiffness, length - start_length);
}

LinkTangent link_tangent(const StepSpring& spring, const Vec3& d) {
  const double length = std::sqrt(d.dot(d));
  const double along = spring.stiffness + spring.damper_stiffness;
  if (length == 0.0) {
    const double k = spring.rest_length == 0.0 ? spring.stiffness : 0.0;
    return {Vec3::Zero(), k, k};
  }
  const double across = std::clamp(spring.tension(length) / length, 0.0, along);
  return {d / length, along, across};
}

void ImplicitSystem::rebuild(const Lattice& lattice, std::span<const std::int32_t> points) {
  points_.clear();
  springs_.clear();
  couplings_.clear();
  mass_.clear();
  first_ = points.empty() ? 0 : points.front();
  row_.assign(points.empty() ? 0 : points.back() - first_ + 1, kNoRow);
  for (std::int32_t p : points) {
    if (lattice.inverse_mass[p] == 0.0) continue;
    row_[p - first_] = static_cast<std::int32_t>(points_.size());
    points_.push_back(p);
    mass_.push_back(lattice.mass[p]);
  }
  std::vector<std::int32_t> active;
  for (std::int32_t p : points_) {
    for (std::int32_t e : lattice.point_edges[p]) {
      if (lattice.active_of_edge[e] >= 0) active.push_back(lattice.active_of_edge[e]);
    }
  }
  std::sort(active.begin(), active.end());
  active.erase(std::unique(active.begin(), active.end()), active.end());
  for (std::int32_t i : active) add_spring(lattice, i);
}

void ImplicitSystem::add_spring(const Lattice& lattice, std::int32_t active) {
  const Spring& s = lattice.active[active];
  if (s.stiffness == 0.0 && s.damping == 0.0) return;  // slack
  Coupling coupling;
  coupling.a = row(s.a);
  coupling.b = row(s.b);
  if (coupling.a == kNoRow) std::swap(coupling.a, coupling.b);
  if (coupling.a == kNoRow) return;
  const bool pinned = lattice.inverse_mass[s.a] == 0.0 || lattice.inverse_mass[s.b] == 0.0;
  if (coupling.b == kNoRow && !pinned) return;
  springs_.push_back(active);
  couplings_.push_back(coupling);
}

void ImplicitSystem::linearise(const Lattice& lattice, double dt,
                               std::span<const double> start_lengths,
                               std::span<const PointSupport> supports) {
  couplings_.resize(springs_.size());
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const Spring& s = lattice.active[springs_[i]];
    const auto [a, b] = std::pair(couplings_[i].a, couplings_[i].b);
    const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
    couplings_[i] = coupling_of(link_tangent(step_spring(s, dt, start_lengths[i]), d), dt);
    couplings_[i].a = a;
    couplings_[i].b = b;
  }
  for (const PointSupport& s : supports) {
    if (row(s.point) == kNoRow) continue;
    couplings_.push_back(coupling_of({s.normal, s.stiffness + s.damping / dt, 0.0}, dt));
    couplings_.back().a = row(s.point);
    couplings_.back().b = kNoRow;
  }
  diagonal_.clear();
  for (double m : mass_) diagonal_.push_back(m * Mat3::Identity());
  for (const Coupling& c : couplings_) {
    diagonal_[c.a] += c.block();
    if (c.b != kNoRow) diagonal_[c.b] += c.block();
  }
}

void ImplicitSystem::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(size());
  for (std::size_t i = 0; i < mass_.size(); ++i) {
    y.segment<3>(3 * i) = mass_[i] * x.segment<3>(3 * i);
  }
  for (const Coupling& c : couplings_) {
    const bool pair = c.b != kNoRow;
    const Vec3 w = pair ? Vec3(part(x, c.a) - part(x, c.b)) : part(x, c.a);
    const Vec3 product = c.across * w + c.root.dot(w) * c.root;
    y.segment<3>(3 * c.a) += product;
    if (pair) y.segment<3>(3 * c.b) -= product;
  }
}

}  // namespace limber
