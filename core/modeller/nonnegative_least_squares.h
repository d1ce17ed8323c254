#pragma once

#include <Eigen/Core>

namespace limber {

// The x >= 0 that minimises x.H x / 2 - g.x for a symmetric positive definite H: the normal
// equations H = A^T A, g = A^T b of a least-squares problem A x = b. Active sets after Lawson and
// Hanson, Solving Least Squares Problems (1974), chapter 23.
Eigen::VectorXd nonnegative_minimum(const Eigen::MatrixXd& H, const Eigen::VectorXd& g);

}  // namespace limber
