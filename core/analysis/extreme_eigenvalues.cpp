#include "core/analysis/extreme_eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/model/errors.h"

namespace limber {
namespace {

[[noreturn]] void fail_to_converge(const char* which) {
  throw SimulationError({"vibration", std::string(which) + " did not converge",
                         "check the model for springs or masses of very different size"});
}

// Lanczos's three-term recurrence: A = Q T Q^T with T tridiagonal, one row of it a step.
class Lanczos {
 public:
  Lanczos(const SparseMatrix& lower, double magnitude)
      : lower_(lower), magnitude_(magnitude), now_(random_block(lower.rows(), 1).normalized()) {}

  void step() {
    Eigen::VectorXd next = lower_.selfadjointView<Eigen::Lower>() * now_;
    if (!side_.empty()) next -= side_.back() * before_;
    diagonal_.push_back(now_.dot(next));
    next -= diagonal_.back() * now_;
    side_.push_back(next.norm());
    before_ = now_;
    if (side_.back() > 0.0) now_ = next / side_.back();
  }

  struct Estimate {
    double value, error;  // there is an eigenvalue within `error` of `value`
  };
  // T / magnitude + 2 has eigenvalues from 1 to 3. Those of T may be zero several times over, and
  // there Eigen's QR steps may go on for ever: they take an entry beside the diagonal for zero by
  // the size of the diagonal next to it.
  Estimate largest() const {
    const auto n = static_cast<Eigen::Index>(diagonal_.size());
    const Eigen::VectorXd diagonal = Eigen::VectorXd::Map(diagonal_.data(), n) / magnitude_;
    const Eigen::VectorXd side = Eigen::VectorXd::Map(side_.data(), n - 1) / magnitude_;
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal((diagonal.array() + 2.0).matrix(), side);
    if (solver.info() != Eigen::Success) fail_to_converge("the highest frequency");
    const double last = solver.eigenvectors()(n - 1, n - 1);
    return {(solver.eigenvalues()[n - 1] - 2.0) * magnitude_, side_.back() * std::abs(last)};
  }
  std::size_t steps() const { return diagonal_.size(); }
  bool exhausted() const { return side_.back() <= 1e-15 * magnitude_; }

 private:
  const SparseMatrix& lower_;
  double magnitude_;  // no eigenvalue has a larger one
  Eigen::VectorXd before_, now_;
  std::vector<double> diagonal_, side_;
};

using Cholesky = Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower>;

// Makes A + shift I positive definite by a shift as small as that takes, within a factor of 100.
void factorise_shifted(Cholesky& cholesky, const SparseMatrix& lower, double magnitude) {
  cholesky.analyzePattern(lower);
  for (double share = 1e-9; share < 20.0; share *= 100.0) {
    cholesky.setShift(magnitude == 0.0 ? 1.0 : share * magnitude);
    cholesky.factorize(lower);
    if (cholesky.info() == Eigen::Success) return;
  }
  fail_to_converge("the factorisation of the stiffness");
}

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

}  // namespace

double largest_eigenvalue(const SparseMatrix& lower, double error) {
  constexpr std::size_t kMostSteps = 3000;
  const double magnitude = magnitude_bound(lower);
  if (magnitude == 0.0) return 0.0;
  Lanczos lanczos(lower, magnitude);
  for (std::size_t check = 8; lanczos.steps() < kMostSteps; check += check / 2) {
    while (lanczos.steps() < check) {
      lanczos.step();
      if (lanczos.exhausted()) return lanczos.largest().value;
    }
    const Lanczos::Estimate largest = lanczos.largest();
    if (largest.error <= error * magnitude) return largest.value;
  }
  fail_to_converge("the highest frequency");
}

Eigenpairs smallest_eigenpairs(const SparseMatrix& lower, Eigen::Index count) {
  constexpr int kMostIterations = 1000;
  count = std::clamp<Eigen::Index>(count, 0, lower.rows());
  if (count == 0) return {};
  const double magnitude = magnitude_bound(lower);
  Cholesky cholesky;
  factorise_shifted(cholesky, lower, magnitude);
  Eigen::MatrixXd block = random_block(lower.rows(), std::min(lower.rows(), 2 * count + 8));
  Eigen::ArrayXd before = Eigen::ArrayXd::Constant(count, magnitude);
  for (int i = 0; i < kMostIterations; ++i) {
    const Eigen::MatrixXd basis = orthonormal(cholesky.solve(block));
    const Eigen::MatrixXd image = lower.selfadjointView<Eigen::Lower>() * basis;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(basis.transpose() * image);
    const Eigen::ArrayXd values = ritz.eigenvalues().head(count);
    block = basis * ritz.eigenvectors();
    if (((values - before).abs() <= 1e-12 * values.abs() + 1e-15 * magnitude).all()) {
      return {values, block.leftCols(count)};
    }
    before = values;
  }
  fail_to_converge("the lowest frequencies");
}

Eigen::MatrixXd random_block(Eigen::Index rows, Eigen::Index columns) {
  // The engine's numbers are the same everywhere; those of a std distribution are not.
  std::mt19937 random(1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random() / 4294967296.0 - 0.5; });
}

double magnitude_bound(const SparseMatrix& lower) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(lower.rows());
  for (Eigen::Index j = 0; j < lower.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(lower, j); entry; ++entry) {
      sum[j] += std::abs(entry.value());
      if (entry.row() != j) sum[entry.row()] += std::abs(entry.value());
    }
  }
  return sum.size() == 0 ? 0.0 : sum.maxCoeff();
}

}  // namespace limber
