#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/lattice.h"

namespace limber {

// What pushes a point along a normal, linearised: a penalty contact, a soft ground. Its force is
// part of lattice.force already.
struct PointSupport {
  std::int32_t point = 0;
  Vec3 normal = Vec3::Zero();  // unit vector
  double stiffness = 0.0;      // N/m
  double damping = 0.0;        // N s/m
};

// A spring within an implicit step, along its length L. Its damper pulls with the mean rate of the
// step, c (L - L_start) / dt: a second spring, of stiffness c / dt. So both have a potential, the
// matrix is symmetric, and no damper gives energy back, however far the spring turns in a step.
struct StepSpring {
  double stiffness = 0.0;         // k, N/m
  double rest_length = 0.0;       // L0, m
  double damper_stiffness = 0.0;  // c / dt, N/m
  double start_length = 0.0;      // m

  double tension(double length) const {  // N
    return stiffness * (length - rest_length) + damper_stiffness * (length - start_length);
  }
  double potential(double length) const;  // J, of both
};

inline StepSpring step_spring(const Spring& s, double dt, double start_length) {
  return {s.stiffness, s.rest_length, s.damping / dt, start_length};
}

// How the force of a spring on one end resists that end's motion, N/m, as a symmetric and positive
// semidefinite matrix: across I + (along - across) n n^T.
struct LinkTangent {
  Vec3 direction = Vec3::Zero();  // n; zero for coincident points
  double along = 0.0;
  double across = 0.0;
};

// d = x_b - x_a, m. Along the spring its stiffness; across it T / L for a tension T, which turns
// with the spring, and nothing for a pressure: that would make the matrix indefinite (Choi and Ko
// 2002, "Stable but responsive cloth"). It is the matrix that errs there, not the force.
// Coincident points: k all round for L0 = 0, else nothing, as they feel no force.
LinkTangent link_tangent(const StepSpring& spring, const Vec3& d);

// One spring in A, kg: the block S = across I + root root^T is added at (a, a) and (b, b), and
// subtracted at (a, b) and (b, a).
struct Coupling {
  std::int32_t a = 0, b = 0;  // rows of points; b = -1: pinned, or none
  double across = 0.0;        // kg
  Vec3 root = Vec3::Zero();   // sqrt(kg)

  Mat3 block() const { return across * Mat3::Identity() + root * root.transpose(); }
};

// The matrix A = M + dt C + dt^2 K (kg) of an implicit step, K = -dF/dx and C = -dF/dv, for the
// points of a set that are not pinned, three rows each. It is kept as springs: a product with it is
// one pass over them, a fifth of what a sparse matrix has to read, and the two ends of a spring get
// the same impulse.
class ImplicitSystem {
 public:
  // Takes the points (ascending), and the active springs that join two of them or one and a pinned
  // point, at the cost of these.
  void rebuild(const Lattice& lattice, std::span<const std::int32_t> points);

  // A for a step of dt (s) at the points' present positions; the lengths (m) of springs() when it
  // started.
  void linearise(const Lattice& lattice, double dt, std::span<const double> start_lengths,
                 std::span<const PointSupport> supports);

  // y = A x: N s from m/s.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

  const std::vector<std::int32_t>& points() const { return points_; }    // of the rows
  const std::vector<std::int32_t>& springs() const { return springs_; }  // active ones
  const std::vector<Coupling>& couplings() const { return couplings_; }  // springs, then supports
  const std::vector<Mat3>& diagonal() const { return diagonal_; }        // blocks of A, kg
  std::int32_t row(std::int32_t point) const {                           // -1: none
    const std::int32_t i = point - first_;
    return i < 0 || i >= static_cast<std::int32_t>(row_.size()) ? -1 : row_[i];
  }
  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(points_.size()); }

 private:
  void add_spring(const Lattice& lattice, std::int32_t active);

  std::vector<std::int32_t> points_, springs_;
  std::int32_t first_ = 0;         // point
  std::vector<std::int32_t> row_;  // of the points from the first to the last
  std::vector<Coupling> couplings_;
  std::vector<double> mass_;  // kg, of the rows
  std::vector<Mat3> diagonal_;
};

}  // namespace limber
