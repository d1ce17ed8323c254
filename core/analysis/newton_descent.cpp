#include "core/analysis/newton_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analysis/extreme_eigenvalues.h"
#include "core/dynamics/spring_force.h"

namespace limber {
namespace {

double edge_length(const PhysicalModel& model, EdgeId e) {
  const auto [a, b] = model.geometry.edges[e];
  return (model.geometry.points[b] - model.geometry.points[a]).norm();
}

}  // namespace

NewtonDescent::NewtonDescent(PhysicalModel& model, const Vec3& gravity_m_s2)
    : model_(model), gravity_(gravity_m_s2), free_(sprung_points(model)) {
  cholesky_.analyzePattern(tangent_stiffness(model_, free_));
  linearise();
}

double NewtonDescent::residual() const {
  return force_.size() == 0 ? 0.0
                            : force_.reshaped(3, free_.points.size()).colwise().norm().maxCoeff();
}

double NewtonDescent::load() const {
  double largest = 0.0;
  for (PointId p : free_.points) {
    largest = std::max(largest, model_.points[p].mass * gravity_.norm());
  }
  for (EdgeId e : ids_of(model_.edges)) {
    const auto [a, b] = model_.geometry.edges[e];
    if (model_.edges[e].broken || (free_.row[a] < 0 && free_.row[b] < 0)) continue;
    const double stretch = edge_length(model_, e) - model_.edges[e].rest_length;
    largest =
        std::max(largest, std::abs(spring_tension(model_.edges[e].stiffness, 0.0, stretch, 0.0)));
  }
  return largest;
}

double NewtonDescent::rounding() const {
  double coordinate = 0.0;
  for (const Vec3& p : model_.geometry.points)
    coordinate = std::max(coordinate, p.cwiseAbs().maxCoeff());
  return std::numeric_limits<double>::epsilon() * magnitude_bound(stiffness_) * coordinate;
}

bool NewtonDescent::step() { return descend(cholesky_.solve(force_)); }

bool NewtonDescent::leave_saddle() {
  const Eigenpairs softest = smallest_eigenpairs(stiffness_, 1);
  if (softest.values[0] >= 0.0) return false;
  double reach = 0.0;  // m, of the point that moves most
  for (const EdgeAttributes& edge : model_.edges) reach = std::max(reach, edge.rest_length);
  Eigen::VectorXd displacement = softest.vectors.col(0);
  displacement *= reach / displacement.cwiseAbs().maxCoeff();
  return descend(displacement) || descend(-displacement);
}

void NewtonDescent::polish() {
  for (bool improved = stable_; improved;) {
    const IdVector<PointId, Vec3> before = model_.geometry.points;
    const double residual_before = residual();
    move(cholesky_.solve(force_));
    improved = residual() < 0.5 * residual_before;
    if (residual() < residual_before) continue;
    model_.geometry.points = before;
    linearise();
  }
}

void NewtonDescent::linearise() {
  const IdVector<PointId, Vec3> springs = spring_forces(model_);
  force_.resize(free_.size());
  for (PointId p : free_.points) {
    force_.segment<3>(free_.row[p]) = springs[p] + model_.points[p].mass * gravity_;
  }
  stiffness_ = tangent_stiffness(model_, free_);
  factorise();
}

// Where the stiffness is not positive definite, compression is left out, which turns springs away:
// what remains is k n n^T and the stiffening by tension. Rejected: the exact stiffness plus the
// least shift that makes it definite. It follows the worst direction, the shortest wave of a
// compressed rope, and takes hundreds of steps to smooth it again.
void NewtonDescent::factorise() {
  constexpr double kRounding = 1e-11;  // so much instability drowns in the rounding of mechanisms
  constexpr double kSlack = 1e-9;      // for what has no stiffness at all without compression
  stable_ = factorise_shifted(stiffness_, 0.0) || factorise_shifted(stiffness_, kRounding);
  if (stable_) return;
  PhysicalModel relieved = model_;
  for (EdgeId e : ids_of(relieved.edges)) {
    double& rest_length = relieved.edges[e].rest_length;
    rest_length = std::min(rest_length, edge_length(model_, e));
  }
  factorise_shifted(tangent_stiffness(relieved, free_), kSlack);
}

bool NewtonDescent::factorise_shifted(const SparseMatrix& stiffness, double share) {
  cholesky_.setShift(share * magnitude_bound(stiffness_));
  cholesky_.factorize(stiffness);
  return cholesky_.info() == Eigen::Success;
}

bool NewtonDescent::descend(Eigen::VectorXd displacement) {
  constexpr double kSufficient = 1e-4;  // of what the unbalanced forces promise (Armijo)
  constexpr int kMostHalvings = 40;
  displacement *= allowed_share(displacement);
  for (int i = 0; i < kMostHalvings; ++i) {
    const double change = energy_change(displacement);
    if (change < 0.0 && change <= -kSufficient * force_.dot(displacement)) {
      move(displacement);
      return true;
    }
    displacement *= 0.5;
  }
  return false;
}

// A straight step is of use as long as springs turn little: at most by about 45 degrees.
double NewtonDescent::allowed_share(const Eigen::VectorXd& displacement) const {
  constexpr double kMostTurn = 1.0;
  double share = 1.0;
  for (EdgeId e : ids_of(model_.edges)) {
    if (model_.edges[e].broken) continue;
    const auto [a, b] = model_.geometry.edges[e];
    const double change = (part(displacement, b) - part(displacement, a)).norm();
    const double most = kMostTurn * std::max(edge_length(model_, e), model_.edges[e].rest_length);
    if (share * change > most) share = most / change;
  }
  return share;
}

// Of elastic and gravitational energy, J. Differences are taken spring by spring: two total
// energies would agree in all their digits long before the forces balance.
double NewtonDescent::energy_change(const Eigen::VectorXd& displacement) const {
  double change = 0.0;
  for (EdgeId e : ids_of(model_.edges)) {
    if (model_.edges[e].broken) continue;
    const auto [a, b] = model_.geometry.edges[e];
    const Vec3 d = model_.geometry.points[b] - model_.geometry.points[a];
    const Vec3 u = part(displacement, b) - part(displacement, a);
    const double before = d.norm(), after = (d + u).norm();
    if (before + after == 0.0) continue;
    const double longer = (2.0 * d + u).dot(u) / (before + after);
    const double mean_stretch = 0.5 * (before + after) - model_.edges[e].rest_length;
    change += model_.edges[e].stiffness * mean_stretch * longer;
  }
  for (PointId p : free_.points) {
    change -= model_.points[p].mass * gravity_.dot(part(displacement, p));
  }
  return change;
}

void NewtonDescent::move(const Eigen::VectorXd& displacement) {
  for (PointId p : free_.points) model_.geometry.points[p] += part(displacement, p);
  linearise();
}

Vec3 NewtonDescent::part(const Eigen::VectorXd& x, PointId p) const {
  if (free_.row[p] < 0) return Vec3::Zero();
  return x.segment<3>(free_.row[p]);
}

}  // namespace limber
