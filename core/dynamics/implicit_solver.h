#pragma once

#include <Eigen/SparseCholesky>
#include <array>
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

// Multiplications of a factorisation in bands, one for each level of a breadth-first search through
// the springs (Cuthill and McKee 1969). Ordering by minimum degree needs fewer: half of it for
// ropes and beams, a fifth for cubes. To know that takes the ordering, and for large solids its
// memory.
double band_multiplications(const ImplicitSystem& system);

// Solves A x = b by a sparse L D L^T factorisation. Its ordering of the rows (approximate minimum
// degree) holds for all A of the same springs.
class FactorisedSolver {
 public:
  explicit FactorisedSolver(const ImplicitSystem& system);

  LinearSolution solve(const ImplicitSystem& system, const Eigen::VectorXd& b);

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  using BlockEntry = std::array<Eigen::Index, 3>;  // of the block's first value in each column
  BlockEntry find_block(std::int32_t row, std::int32_t column) const;
  void refill(const ImplicitSystem& system);

  Matrix lower_;
  std::vector<BlockEntry> diagonal_;   // of the rows
  std::vector<BlockEntry> couplings_;  // of the springs between two rows
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> cholesky_;
};

}  // namespace limber
