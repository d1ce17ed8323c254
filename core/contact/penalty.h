#pragma once

#include <algorithm>
#include <cmath>

#include "core/model/vec3.h"

namespace limber {

// The penalty law shared by point-point and point-body contact. Stiffness and damping follow from
// masses: k = omega_c^2 m, c = 2 zeta omega_c m, with m the reduced mass of the pair, so that the
// contact's own frequency is omega_c whatever the masses are.
struct PenaltyContact {
  double frequency = 0.0;      // omega_c, rad/s
  double damping_ratio = 0.0;  // zeta
  double friction = 0.0;       // Coulomb coefficient
};

// Restitution of a spring-dashpot contact that never pulls, for damping ratios below 1:
// e = exp(-zeta / s (pi - atan2(2 zeta s, 1 - 2 zeta^2))), s = sqrt(1 - zeta^2)
// (Schwager and Poeschel, Granular Matter 9, 2007).
inline double restitution_of_damping_ratio(double zeta) {
  const double s = std::sqrt(1.0 - zeta * zeta);
  return std::exp(-zeta / s * (M_PI - std::atan2(2.0 * zeta * s, 1.0 - 2.0 * zeta * zeta)));
}

// More damping than this (restitution 0.21) costs stable step and changes a contact little.
inline constexpr double kLargestContactDamping = 0.7;

// The inverse, by bisection (the restitution falls with the damping). A restitution below 0.21
// counts as 0.21: what else a body loses in an impact its own springs and friction take.
inline double damping_ratio_of_restitution(double restitution) {
  double low = 0.0, high = kLargestContactDamping;
  if (restitution <= restitution_of_damping_ratio(high)) return high;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (restitution_of_damping_ratio(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Normal force, N, never adhesive: max(0, k depth - c separation_speed).
inline double penalty_force(const PenaltyContact& law, double reduced_mass, double depth,
                            double separation_speed) {
  const double k = law.frequency * law.frequency * reduced_mass;
  const double c = 2.0 * law.damping_ratio * law.frequency * reduced_mass;
  return std::max(0.0, k * depth - c * separation_speed);
}

// Share of the tangential momentum that sticking friction removes in one substep. 1 would stop a
// point at once and take a quarter of the explicit step's stability limit
// (4 - 2 C dt - K dt^2 >= 0 with C dt = 1 ...); 0.1 stops it in ten substeps and takes a twentieth.
inline constexpr double kFrictionShare = 0.1;

// Coulomb friction, N: opposes the slip, at most mu N, and at most what removes kFrictionShare of
// the slip within dt.
inline Vec3 friction_force(double friction, double normal_force, double reduced_mass,
                           const Vec3& slip_velocity, double dt) {
  const double speed = slip_velocity.norm();
  if (speed == 0.0) return Vec3::Zero();
  const double sticking = kFrictionShare * reduced_mass * speed / dt;
  return slip_velocity * (-std::min(friction * normal_force, sticking) / speed);
}

}  // namespace limber
