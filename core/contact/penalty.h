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

// Damping ratio of a linear spring-dashpot contact that rebounds with restitution e:
// zeta = -ln e / sqrt(pi^2 + ln^2 e) (Nagurka and Huang, 2004). Restitution below 0.05 counts as
// 0.05 (zeta 0.69): more damping only makes the contact stick.
inline double damping_ratio_of_restitution(double restitution) {
  const double log_e = std::log(std::clamp(restitution, 0.05, 1.0));
  return -log_e / std::sqrt(M_PI * M_PI + log_e * log_e);
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
