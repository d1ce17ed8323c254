#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <vector>

#include "core/dynamics/implicit_solver.h"

namespace limber {

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
