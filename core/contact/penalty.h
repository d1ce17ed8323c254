#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/vec3.h"

namespace limber {

// The penalty law shared by point-point and point-body contact. The stiffness follows from masses,
// k = omega_c^2 m with m the reduced mass of the pair, so that the contact's own frequency is
// omega_c whatever the masses are. A contact may be stiffer from some depth on: what is soft where
// it touches then still bears what is heavy.
struct PenaltyContact {
  double frequency = 0.0;                                       // omega_c, rad/s
  double restitution = 0.0;                                     // e, 0..1
  double friction = 0.0;                                        // Coulomb coefficient
  double soft_depth = std::numeric_limits<double>::infinity();  // m, to which omega_c holds
  double deep_frequency = 0.0;                                  // rad/s, beyond that
  double deepest = std::numeric_limits<double>::infinity();     // m, see bearing_force()
  bool comes_back = false;                                      // from beyond that

  // Force without restitution, N.
  double elastic_force(double reduced_mass, double depth) const {
    const double soft = std::min(depth, soft_depth);
    return reduced_mass *
           (frequency * frequency * soft + deep_frequency * deep_frequency * (depth - soft));
  }
  // What pressing it in to this depth takes, J.
  double elastic_energy(double reduced_mass, double depth) const {
    const double soft = std::min(depth, soft_depth);
    return 0.5 * (elastic_force(reduced_mass, soft) * soft +
                  (elastic_force(reduced_mass, soft) + elastic_force(reduced_mass, depth)) *
                      (depth - soft));
  }
};

// A contact that gave nothing back would never push out what has come in: a restitution below this
// counts as this (1 % of the energy).
inline constexpr double kLeastRestitution = 0.1;

// Normal force, N, never adhesive: k depth while the two approach, e^2 k depth while they separate
// (Moore and Wilhelms, SIGGRAPH 1988). The contact gives back e^2 of the energy it took whatever
// the mass behind the point is. A dashpot does not: it is made for the point's mass, and a body of
// a thousand points bounces off it almost elastically.
inline double penalty_force(const PenaltyContact& law, double reduced_mass, double depth,
                            double separation_speed) {
  if (depth <= 0.0) return 0.0;
  const double e = std::max(law.restitution, kLeastRestitution);
  return (separation_speed > 0.0 ? e * e : 1.0) * law.elastic_force(reduced_mass, depth);
}

// What has been pressed in deeper than it has to be comes out at this speed, m/s, at the most
// (from there it would rise by half a millimetre), and with this time constant, s, at the end. That
// is aperiodic for all that lies less deep than g kYieldTime^2 / 4 = 2.5 cm, whatever its mass.
inline constexpr double kYieldSpeed = 0.1;
inline constexpr double kYieldTime = 0.1;
inline constexpr double kStopSubsteps = 4.0;

// Normal force, N, of a contact that may have to bear a load. Moore and Wilhelms' law has two
// values at rest, k d and e^2 k d: what is borne stays as deep as it was ever pressed, and
// trembles. This one lies between them, as a spring and a damper that let out what is too deep at
// the speeds above: k d (1 - s / s_out), by backward Euler, as such a damper is beyond every
// explicit step. So it rests at the depth at which k d bears the load, and hits give back e^2 as
// before.
//
// What the springs do not hold, whose stiffness the step bounds, is stopped before it is deeper
// than `deepest`: it may come no faster than kStopSubsteps would take there. That only takes
// energy.
//
// `separation_without`: m/s after this substep if the contact did nothing, by all other forces; the
// speed of the moment would leave out the load, and what is heavy would creep in. `gain`: m/s by
// which a newton changes that.
inline double bearing_force(const PenaltyContact& law, double reduced_mass, double depth,
                            double separation_without, double gain, double dt) {
  if (depth <= 0.0) return 0.0;
  const double elastic = law.elastic_force(reduced_mass, depth);
  const double out = std::min(depth / kYieldTime, kYieldSpeed);
  const double damped = elastic * (out - separation_without) / (out + elastic * gain);
  const double borne = std::clamp(damped, law.restitution * law.restitution * elastic, elastic);
  const double left = law.deepest - depth;  // m
  double may_close = std::max(0.0, left) / (kStopSubsteps * dt);
  if (left < 0.0 && law.comes_back) may_close = std::max(left / kYieldTime, -kYieldSpeed);
  return std::max(borne, (-separation_without - may_close) / gain);
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
