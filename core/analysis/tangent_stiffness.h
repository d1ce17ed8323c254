#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "core/model/physical_model.h"

namespace limber {

// Internal to core/analysis and core/dynamics: the unbroken springs of a model, linearised where
// its points are.

using SparseMatrix = Eigen::SparseMatrix<double>;

// Points that may move: three rows each in vectors and matrices.
struct FreePoints {
  std::vector<PointId> points;          // ascending
  IdVector<PointId, Eigen::Index> row;  // first of the three; -1 for points that do not move

  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(points.size()); }
};

// All points that are not pinned; those of them that an unbroken spring holds.
FreePoints unpinned_points(const PhysicalModel& model);
FreePoints sprung_points(const PhysicalModel& model);

// d = x_b - x_a. dF_a/dx_b of a spring, N/m: k n n^T + k (1 - L0/L) (I - n n^T), the second part
// being its tension turning with it (geometric stiffness). Coincident points have none.
Mat3 spring_stiffness(double stiffness, double rest_length, const Vec3& d);

// Stiffness across a spring over that along it, and at least as much as it has on its way from a
// length to its rest length: 1 - L0 / L under tension; compression counts as none, and one shorter
// than half its rest length may turn any way: 1.
double sideways_stiffness_bound(double rest_length, double length);

// spring_stiffness() with that across.
Mat3 spring_stiffness_bound(double stiffness, double rest_length, const Vec3& d);

// K = -dF/dx of the free points, N/m: its lower triangle. The pattern does not depend on positions.
SparseMatrix tangent_stiffness(const PhysicalModel& model, const FreePoints& free);

// Sum of the springs' forces on each point, N, pinned ones included; velocities do not count.
IdVector<PointId, Vec3> spring_forces(const PhysicalModel& model);

// 1 / sqrt(m) of every row.
Eigen::VectorXd mass_scale(const PhysicalModel& model, const FreePoints& free);

// Lower triangle of M^-1/2 K M^-1/2 of the points that are not pinned: its eigenvalues are omega^2,
// (rad/s)^2.
SparseMatrix scaled_stiffness(const PhysicalModel& model);

// The same by spring_stiffness_bound().
SparseMatrix scaled_stiffness_bound(const PhysicalModel& model);

}  // namespace limber
