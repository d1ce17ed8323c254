#pragma once

#include <limits>

#include "core/model/physical_model.h"

namespace limber {

// Largest stable step, s, of explicit integrators for x'' + 2 zeta omega x' + omega^2 x = 0: that
// of a lattice of which omega (rad/s, > 0) is the highest frequency and zeta the damping ratio
// there, if damping is proportional to stiffness. For semi-implicit Euler see
// core/dynamics/stable_step.h.

// |1 + h lambda| <= 1 for lambda = omega (-zeta +- sqrt(zeta^2 - 1)): 2 zeta / omega up to critical
// damping, 2 / (zeta + sqrt(zeta^2 - 1)) / omega beyond; without damping no step is stable.
double explicit_euler_step_limit(double omega_rad_s, double damping_ratio);

// |R(h lambda)| <= 1 for R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24, along the ray of lambda (Hairer and
// Wanner, Solving Ordinary Differential Equations II, section IV.2): 2 sqrt(2) / omega without
// damping, 2.785 over the faster of the two rates of an overdamped oscillator.
double runge_kutta4_step_limit(double omega_rad_s, double damping_ratio);

// Of a method that is stable at any step.
constexpr double no_step_limit(double, double) { return std::numeric_limits<double>::infinity(); }

// Upper bound on the frequencies at any deformation, rad/s. The tangent stiffness of a spring, k n
// n^T + k (1 - L0 / L) (I - n n^T), is at most k I however it is turned and stretched, so that no
// frequency exceeds the highest of the same springs with stiffness k in all three directions. 1 to
// 2 times the highest frequency of the undeformed lattice.
double large_strain_frequency(const PhysicalModel& model);

}  // namespace limber
