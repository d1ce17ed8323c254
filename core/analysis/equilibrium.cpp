#include "core/analysis/equilibrium.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "core/analysis/extreme_eigenvalues.h"
#include "core/analysis/newton_descent.h"
#include "core/analysis/tangent_stiffness.h"
#include "core/model/errors.h"

namespace limber {
namespace {

// Each point's representative in a forest of unbroken springs (union-find, halving paths).
class Pieces {
 public:
  explicit Pieces(const PhysicalModel& model) : parent_(model.points.size()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (EdgeId e : ids_of(model.edges)) {
      if (model.edges[e].broken) continue;
      const auto [a, b] = model.geometry.edges[e];
      parent_[of(a.index())] = of(b.index());
    }
  }
  std::size_t of(std::size_t point) {
    while (parent_[point] != point) point = parent_[point] = parent_[parent_[point]];
    return point;
  }

 private:
  std::vector<std::size_t> parent_;
};

void require_pins(const PhysicalModel& model) {
  Pieces pieces(model);
  std::vector<char> held(model.points.size(), false);
  for (PointId p : ids_of(model.points)) {
    if (model.points[p].pinned) held[pieces.of(p.index())] = true;
  }
  for (PointId p : sprung_points(model).points) {
    if (held[pieces.of(p.index())]) continue;
    throw InputError({model.name + ": point " + std::to_string(p.value),
                      "gravity acts on its piece and no pin holds that", "pin some of its points"});
  }
}

// Knows how near to singular the matrix was: its smallest pivot. Rounding hides an exact zero.
class PivotedCholesky : public Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> {
 public:
  double smallest_pivot() const { return m_matrix.diagonal().cwiseAbs2().minCoeff(); }
};

Eigen::VectorXd solve_definite(const std::string& name, const SparseMatrix& lower,
                               const Eigen::VectorXd& right_side) {
  constexpr double kRounding = 1e-13;
  PivotedCholesky cholesky;
  cholesky.compute(lower);
  if (cholesky.info() != Eigen::Success ||
      cholesky.smallest_pivot() <= kRounding * magnitude_bound(lower)) {
    throw InputError({name, "a part of it moves without force", "pin more points or add edges"});
  }
  return cholesky.solve(right_side);
}

}  // namespace

Equilibrium settle(PhysicalModel& model, const Vec3& gravity_m_s2,
                   const EquilibriumSettings& settings) {
  if (!gravity_m_s2.isZero(0.0)) require_pins(model);
  NewtonDescent descent(model, gravity_m_s2);
  const auto balanced = [&] {
    return descent.residual() <= settings.tolerance * descent.load() + descent.rounding();
  };
  Equilibrium result;
  for (bool moved = true; moved && result.iterations < settings.most_iterations;) {
    if (balanced() && descent.stable()) break;
    moved = balanced() ? descent.leave_saddle() : descent.step();
    result.iterations += moved;
  }
  result.converged = balanced() && descent.stable();
  descent.polish();
  result.residual_N = descent.residual();
  for (PointAttributes& point : model.points) point.velocity = Vec3::Zero();
  return result;
}

IdVector<PointId, Vec3> linear_sag(const PhysicalModel& model, const Vec3& gravity_m_s2) {
  require_pins(model);
  const FreePoints free = sprung_points(model);
  IdVector<PointId, Vec3> sag(model.points.size(), Vec3::Zero());
  if (free.points.empty()) return sag;
  Eigen::VectorXd weight(free.size());
  for (PointId p : free.points) {
    weight.segment<3>(free.row[p]) = model.points[p].mass * gravity_m_s2;
  }
  const Eigen::VectorXd displacement =
      solve_definite(model.name, tangent_stiffness(model, free), weight);
  for (PointId p : free.points) sag[p] = displacement.segment<3>(free.row[p]);
  return sag;
}

IdVector<PointId, Vec3> support_forces(const PhysicalModel& model, const Vec3& gravity_m_s2) {
  const IdVector<PointId, Vec3> springs = spring_forces(model);
  IdVector<PointId, Vec3> support(model.points.size(), Vec3::Zero());
  for (PointId p : ids_of(model.points)) {
    if (model.points[p].pinned) support[p] = -springs[p] - model.points[p].mass * gravity_m_s2;
  }
  return support;
}

}  // namespace limber
