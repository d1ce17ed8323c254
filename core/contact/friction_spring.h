#pragma once

#include <algorithm>
#include <cmath>

#include "core/contact/penalty.h"

namespace limber {

// Coulomb friction that holds: where a contact sticks it is a spring across the normal (Cundall and
// Strack, Geotechnique 29, 1979), so that what lies on a slope stays there. friction_force() alone
// only slows what slips and lets it creep by about g dt / kFrictionShare.
struct FrictionSpring {
  // Of a pull. Much less than the turns in which a resting contact presses, some ten substeps.
  static constexpr double kForgetShare = 0.01;

  Vec3 stretch = Vec3::Zero();  // m, since the contact sticks
  double pressed = 0.0;         // N: the largest normal force lately
  double taken = 0.0;           // J that it has taken in, heat included, less what it gave back
  Vec3 force = Vec3::Zero();    // N, of the last substep
  Vec3 slip = Vec3::Zero();     // m/s, before it

  // Force, N, against the slip velocity (m/s, across the unit normal): never more than mu N. The
  // spring has the law's frequency omega_c; the damper of friction_force() acts beside it.
  //
  // A contact that bears a load presses in turns, with k d and with e^2 k d (penalty_force()). So
  // the spring gives way at mu times the largest N of the last 1 / kForgetShare substeps or so: if
  // it did so at the present one, it would slip a little each time it is pressed less. It pulls no
  // harder for that, but it may be stretched while it is pressed less than when it is let go; so it
  // holds no more than friction has taken in all. (To hold no more than the work of its stretching,
  // without the heat of slips, would be stricter, but then things creep on slopes again: 5 cm in 3
  // s at nine tenths of mu.)
  Vec3 pull(const PenaltyContact& law, double normal_force, double reduced_mass, const Vec3& normal,
            const Vec3& slip_velocity, double dt) {
    settle(slip_velocity, dt);
    pressed = std::max(normal_force, (1.0 - kForgetShare) * pressed);
    stretch += slip_velocity * dt;
    stretch -= stretch.dot(normal) * normal;
    const double k = law.frequency * law.frequency * reduced_mass;
    const double holding = k * stretch.norm(), longest = law.friction * pressed;
    if (holding > longest) stretch *= longest / holding;
    const double stored = 0.5 * k * stretch.squaredNorm();
    if (stored > taken) stretch *= std::sqrt(std::max(0.0, taken) / stored);
    force = -k * stretch - (kFrictionShare * reduced_mass / dt) * slip_velocity;
    slip = slip_velocity;
    const double size = force.norm(), most = law.friction * normal_force;
    if (size > most) force *= most / size;
    return force;
  }

  // The last pull did its work. `slip_now`: the velocity after it at the same place, m/s.
  void settle(const Vec3& slip_now, double dt) {
    taken -= 0.5 * dt * force.dot(slip + slip_now);
    force.setZero();
  }
};

}  // namespace limber
