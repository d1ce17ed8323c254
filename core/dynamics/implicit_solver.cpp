#include "core/dynamics/implicit_solver.h"

#include <Eigen/Cholesky>

namespace limber {
namespace {

// Where a spring is so stiff that rounding swallows the mass, the block is singular: this share of
// it is added all round. It slows convergence a little and changes no solution.
constexpr double kShift = 1e-12;

Mat3 inverse_root(const Mat3& block) {
  const Mat3 shifted = block + kShift * block.trace() * Mat3::Identity();
  return shifted.llt().matrixL().solve(Mat3::Identity());
}

}  // namespace

BlockPreconditioner::BlockPreconditioner(const std::vector<Mat3>& diagonal) {
  root_.reserve(diagonal.size());
  for (const Mat3& block : diagonal) root_.push_back(inverse_root(block));
}

Eigen::VectorXd BlockPreconditioner::apply(const Eigen::VectorXd& impulse) const {
  Eigen::VectorXd velocity(impulse.size());
  for (std::size_t i = 0; i < root_.size(); ++i) {
    const Vec3 half = root_[i].triangularView<Eigen::Lower>() * impulse.segment<3>(3 * i);
    velocity.segment<3>(3 * i) = root_[i].transpose().triangularView<Eigen::Upper>() * half;
  }
  return velocity;
}

LinearSolution conjugate_gradients(const ImplicitSystem& system, const BlockPreconditioner& inverse,
                                   const Eigen::VectorXd& b, double tolerance,
                                   int most_iterations) {
  LinearSolution solution{Eigen::VectorXd::Zero(b.size()), 0, false};
  Eigen::VectorXd residual = b, product;
  Eigen::VectorXd direction = inverse.apply(b), relaxed = direction;
  double energy = residual.dot(relaxed);
  const double enough = tolerance * tolerance * energy;
  while (energy > enough && solution.iterations < most_iterations) {
    system.multiply(direction, product);
    const double length = energy / direction.dot(product);
    solution.x += length * direction;
    residual -= length * product;
    relaxed = inverse.apply(residual);
    const double before = energy;
    energy = residual.dot(relaxed);
    direction = relaxed + (energy / before) * direction;
    ++solution.iterations;
  }
  solution.converged = energy <= enough;  // false for a NaN
  return solution;
}

}  // namespace limber
