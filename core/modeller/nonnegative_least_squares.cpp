#include "core/modeller/nonnegative_least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <vector>

namespace limber {
namespace {

using Indices = std::vector<Eigen::Index>;

Indices where_true(const std::vector<bool>& flags) {
  Indices indices;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i]) indices.push_back(static_cast<Eigen::Index>(i));
  }
  return indices;
}

// The minimum over the free variables alone, signs ignored; the others are zero.
Eigen::VectorXd free_minimum(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                             const std::vector<bool>& is_free) {
  const Indices free = where_true(is_free);
  const Eigen::MatrixXd block = H(free, free);
  const Eigen::VectorXd right = g(free);
  const Eigen::VectorXd solution = block.llt().solve(right);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(g.size());
  z(free) = solution;
  return z;
}

// How far from x towards z every free variable stays >= 0, within [0, 1].
double feasible_fraction(const Eigen::VectorXd& x, const Eigen::VectorXd& z,
                         const std::vector<bool>& is_free) {
  double fraction = 1.0;
  for (Eigen::Index i : where_true(is_free)) {
    if (z[i] <= 0.0) fraction = std::min(fraction, x[i] / (x[i] - z[i]));
  }
  return fraction;
}

// Walks to the minimum over the free variables, fixing at zero those that it meets there.
void settle(const Eigen::MatrixXd& H, const Eigen::VectorXd& g, std::vector<bool>& is_free,
            Eigen::VectorXd& x) {
  for (;;) {
    const Eigen::VectorXd z = free_minimum(H, g, is_free);
    const double fraction = feasible_fraction(x, z, is_free);
    x += fraction * (z - x);
    if (fraction == 1.0) return;
    for (Eigen::Index i : where_true(is_free)) {
      if (z[i] > 0.0 || x[i] > 1e-14 * x.maxCoeff()) continue;
      x[i] = 0.0;
      is_free[i] = false;
    }
  }
}

// The fixed variable whose growth pays most, or -1 where none pays.
Eigen::Index best_to_free(const Eigen::VectorXd& gain, const std::vector<bool>& is_free,
                          double least) {
  Eigen::Index best = -1;
  for (Eigen::Index i = 0; i < gain.size(); ++i) {
    if (is_free[i] || gain[i] <= least) continue;
    if (best < 0 || gain[i] > gain[best]) best = i;
  }
  return best;
}

}  // namespace

Eigen::VectorXd nonnegative_minimum(const Eigen::MatrixXd& H, const Eigen::VectorXd& g) {
  // Most cells need no bound at all.
  Eigen::VectorXd x = H.llt().solve(g);
  if (x.minCoeff() >= 0.0) return x;

  x.setZero();
  std::vector<bool> is_free(g.size(), false);
  const double least = 1e-12 * g.cwiseAbs().maxCoeff();
  // Every round lowers the objective, so no set of free variables comes twice; 3 n is the bound
  // that is customary against rounding.
  for (Eigen::Index round = 0; round < 3 * g.size(); ++round) {
    const Eigen::Index next = best_to_free(g - H * x, is_free, least);
    if (next < 0) break;
    is_free[next] = true;
    settle(H, g, is_free, x);
  }
  return x;
}

}  // namespace limber
