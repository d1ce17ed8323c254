#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/model/physical_model.h"

namespace limber {

// Small vibrations about where the model is: K v = omega^2 M v with the exact tangent stiffness of
// its unbroken springs, their tension included. Pinned points do not move; a loose one moves
// freely.
struct VibrationModes {
  std::vector<PointId> free_points;  // F, in ascending order; three components each in `shapes`
  Eigen::VectorXd omega_squared;     // shape (3F), (rad/s)^2, ascending; negative where unstable
  Eigen::MatrixXd shapes;            // shape (3F, 3F), one column a mode, M-orthonormal, kg^-1/2;
                                     // signs, and bases of equal frequencies, are arbitrary
};

// All of them, dense: for models of up to about a thousand points.
VibrationModes vibration_modes(const PhysicalModel& model);

// How many leave every length as it is, as far as rounding lets one see: the six rigid motions of a
// free lattice and its floppy mechanisms. Those with |omega^2| below 1e-11 of the largest.
int zero_mode_count(const VibrationModes& modes);

// The `count` lowest (fewer if there are not as many) or the single highest frequency, rad/s,
// iteratively: for models of any size. Unstable directions and zero modes count among the lowest,
// as frequency 0; rounding may show them as up to 1e-7 of the highest. Relative errors are below
// 1e-9 for the highest and for what is above 1e-3 of it, and grow with (highest / omega)^2 below.
// Throw SimulationError where the iteration does not converge.
std::vector<double> lowest_frequencies(const PhysicalModel& model, int count);
double exact_highest_frequency(const PhysicalModel& model);

// Three upper bounds on the highest frequency of the undeformed free lattice, rad/s, by
// Gershgorin's circles. Cheap: one pass over the edges, or over pairs of edges at each point.
struct FrequencyBounds {
  // omega^2 <= max_i sum_e k / m_i + sum_e k / sqrt(m_i m_j)
  double points = 0.0;
  // The first sum replaced by the largest eigenvalue of sum_e k n n^T / m_i.
  double point_blocks = 0.0;
  // Rows of the edges' Gram matrix: omega^2 <= max_e sum_e' sqrt(k k') |n . n'| / m over the points
  // that e and e' share; e' = e counts at both ends.
  double edges = 0.0;
};
FrequencyBounds frequency_bounds(const PhysicalModel& model);

}  // namespace limber
