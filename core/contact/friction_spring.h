#pragma once

#include "core/contact/penalty.h"

namespace limber {

// Coulomb friction that holds: where a contact sticks it is a spring across the normal (Cundall and
// Strack, Geotechnique 29, 1979), so that what lies on a slope stays there. friction_force() alone
// only slows what slips and lets it creep by about g dt / kFrictionShare.
struct FrictionSpring {
  Vec3 stretch = Vec3::Zero();  // m, since the contact sticks

  // Force, N, against the slip velocity (m/s, across the unit normal). The spring has the law's
  // frequency omega_c and gives way at mu N; while it holds, the damper of friction_force() acts
  // beside it. Together they pull with mu N at most.
  Vec3 pull(const PenaltyContact& law, double normal_force, double reduced_mass, const Vec3& normal,
            const Vec3& slip_velocity, double dt) {
    const double most = law.friction * normal_force;
    const double k = law.frequency * law.frequency * reduced_mass;
    stretch += slip_velocity * dt;
    stretch -= stretch.dot(normal) * normal;
    const double holding = k * stretch.norm();
    if (holding > most) {
      stretch *= most / holding;
      return -k * stretch;
    }
    const double c = kFrictionShare * reduced_mass / dt;
    const Vec3 force = -k * stretch - c * slip_velocity;
    const double size = force.norm();
    return size > most ? Vec3(force * (most / size)) : force;
  }
};

}  // namespace limber
