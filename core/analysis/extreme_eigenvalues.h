#pragma once

#include "core/analysis/tangent_stiffness.h"

namespace limber {

// Internal to core/analysis: eigenvalues at the ends of a large symmetric matrix, given by its
// lower triangle. Both throw SimulationError where they do not converge.

// By Lanczos's method, without keeping its vectors: rounding then repeats eigenvalues, which does
// not move the largest (Paige, Journal of the Institute of Mathematics and its Applications 18,
// 1976). There is an eigenvalue within `error` x magnitude_bound() of the result, typically far
// nearer. Where eigenvalues crowd below the largest, as those of a long rope do, the steps grow as
// 1 / sqrt(error).
double largest_eigenvalue(const SparseMatrix& lower, double error = 2e-10);

struct Eigenpairs {
  Eigen::VectorXd values;   // shape (C), ascending
  Eigen::MatrixXd vectors;  // shape (N, C), orthonormal columns
};

// The `count` smallest (all, if there are not as many), by inverse subspace iteration with
// Rayleigh-Ritz (Bathe, Finite Element Procedures, 1996), which finds repeated ones too. Error of
// the values about 1e-15 of the largest magnitude plus 1e-11 of the value.
Eigenpairs smallest_eigenpairs(const SparseMatrix& lower, Eigen::Index count);

// Entries from -0.5 to 0.5, the same every time. Without symmetry: no eigenvector is orthogonal to
// it.
Eigen::MatrixXd random_block(Eigen::Index rows, Eigen::Index columns);

// Largest sum of magnitudes of a row: no eigenvalue has a larger magnitude.
double magnitude_bound(const SparseMatrix& lower);

}  // namespace limber
