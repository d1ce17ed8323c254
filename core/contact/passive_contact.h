#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber {

// The largest impulse, N s, that a contact may give without giving more than it has taken in: an
// impulse J on an effective mass m that closes at u takes in J u - J^2 / (2 m); with what is stored
// before, J, that must not be below zero.
// Where other forces act in the same substep, u is the mean of before and after it without J.
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
  double expected = 0.0;  // m/s: closing speed after it, as foreseen
  double surprise = 0.0;  // m/s by which it closed faster than that
  bool open = false;      // the last substep is not settled

  // The last impulse did its work. `closing_now`: the speed after it along the same normal, m/s.
  void settle(double closing_now) {
    stored += impulse * 0.5 * (closing_speed + closing_now);
    surprise = closing_now - expected;
    open = false;
  }
  void share_mass(double effective_mass) { mass = std::min(mass, effective_mass); }
  // `closing`: m/s, the mean of before the substep and after it without this contact.
  double largest_impulse(double closing) const {
    return largest_passive_impulse(mass, closing, stored);
  }
  // What it costs to ease an overlap out, which was there at first, is not owed, nor is what the
  // contact has by its depth beyond it.
  void forgive(double elastic_J) { stored = std::max(elastic_J, stored); }
  // What the closing speed will be without this contact, m/s: as foreseen by the forces that are
  // known, and what was not in the last substep (what bodies are pushed by, what implicit springs
  // do, who else presses the point).
  double closing_without(double foreseen) const { return foreseen + surprise; }
  // `foreseen`: as above, and with the contact.
  void give(double impulse_N_s, double closing, double foreseen) {
    impulse = impulse_N_s;
    closing_speed = closing;
    expected = foreseen;
    open = true;
  }
};

}  // namespace limber
