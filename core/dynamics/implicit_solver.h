#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/dynamics/implicit_system.h"

namespace limber {

// The inverse of the 3 x 3 blocks on the diagonal of A.
class BlockPreconditioner {
 public:
  explicit BlockPreconditioner(const std::vector<Mat3>& diagonal);
  Eigen::VectorXd apply(const Eigen::VectorXd& impulse) const;  // m/s from N s

 private:
  std::vector<Mat3> root_;  // inverse = root^T root, so that rounding keeps it definite
};

struct LinearSolution {
  Eigen::VectorXd x;   // m/s
  int iterations = 0;  // of conjugate gradients; 0: by factorisation
  bool converged = true;
};

// Solves A x = b from x = 0 by preconditioned conjugate gradients (Hestenes and Stiefel 1952).
// Converged once r^T P^-1 r, an energy, is at most tolerance^2 times what it is for r = b.
LinearSolution conjugate_gradients(const ImplicitSystem& system, const BlockPreconditioner& inverse,
                                   const Eigen::VectorXd& b, double tolerance, int most_iterations);

}  // namespace limber
