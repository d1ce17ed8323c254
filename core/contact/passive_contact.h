#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber {

// The largest impulse, N s, that a contact may give without giving more than it has taken in: an
// impulse J on an effective mass m that closes at u takes in J u - J^2 / (2 m); with what is stored
// before, J, that must not be below zero.
inline double largest_passive_impulse(double mass, double closing_speed, double stored) {
  const double square = closing_speed * closing_speed + 2.0 * stored / mass;
  return std::max(0.0, mass * (closing_speed + std::sqrt(std::max(0.0, square))));
}

// The books of one contact, so that it never gives back more energy than it took, however its
// normal, place and mass change from substep to substep.
struct PassiveContact {
  double mass = std::numeric_limits<double>::infinity();  // kg, effective: never grows
  double stored = 0.0;                                    // J taken in so far
  double impulse = 0.0;                                   // N s, of the last substep
  double closing_speed = 0.0;                             // m/s, before that

  // The last impulse did its work. `closing_now`: the speed after it along the same normal, m/s.
  void settle(double closing_now) {
    stored += impulse * 0.5 * (closing_speed + closing_now);
    impulse = 0.0;
  }
  void share_mass(double effective_mass) { mass = std::min(mass, effective_mass); }
  double largest_impulse(double closing) const {
    return largest_passive_impulse(mass, closing, stored);
  }
  // What it costs to ease an overlap out, which was there at first, is not owed, nor is what the
  // contact has by its depth beyond it.
  void forgive(double elastic_J) { stored = std::max(elastic_J, stored); }
  void give(double impulse_N_s, double closing) {
    impulse = impulse_N_s;
    closing_speed = closing;
  }
};

}  // namespace limber
