#pragma once

#include <algorithm>

#include "core/contact/passive_contact.h"
#include "core/contact/penalty.h"

namespace limber {

// A penetration that was there when a contact was first seen is taken back at this speed, m/s, and
// pushes no faster: it bounds the kinetic energy per mass that easing out may cost to 1.25 mJ/kg,
// and clears a shell's wall of 5 mm in 0.1 s. Without it pieces that thaw again and again sink into
// the floor.
inline constexpr double kEaseSpeed = 0.05;

// Lowers a depth, m, by what was there at first, which is taken back slowly and never grows.
inline double eased(double depth, double& offset, double dt) {
  offset = std::min(std::max(0.0, offset - kEaseSpeed * dt), std::max(0.0, depth));
  return depth - offset;
}

// A contact along its normal as a substep begins.
struct Approach {
  double depth = 0.0;       // m, eased
  double closing = 0.0;     // m/s
  double foreseen = 0.0;    // m/s, at the substep's end by the forces summed so far
  bool foreseeable = true;  // all that acts is among them: nothing implicit
  bool easing = false;      // some of the first depth is left
  double forgiven = 0.0;    // J that it may have beyond what it took in while it is eased
};

// The normal force, N, of bearing_force(), as far as it is passive; it is entered in the books.
// `gain`: m/s by which a newton changes the closing speed within dt.
inline double bear(PassiveContact& books, const PenaltyContact& law, const Approach& at,
                   double gain, double dt) {
  const double without = books.closing_without(at.foreseen);
  double most = books.largest_impulse(at.foreseeable ? 0.5 * (at.closing + without) : at.closing);
  if (at.easing) {
    books.forgive(at.forgiven);
    most = std::max(most, books.mass * (kEaseSpeed + at.closing));
  }
  const double wanted = bearing_force(law, books.mass, at.depth, -without, gain, dt);
  const double press = std::min(wanted, most / dt);
  books.give(press * dt, at.closing, at.foreseen - press * gain);
  return press;
}

}  // namespace limber
