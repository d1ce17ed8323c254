#pragma once

#include <string>

#include "core/dynamics/lattice.h"
#include "core/dynamics/quanta.h"
#include "core/model/errors.h"

namespace limber {

// Throws SimulationError for a spring that single precision cannot measure any more.
inline void require_measurable(const Lattice& lattice, std::int32_t edge, const Quanta& quanta) {
  const double length = length_of(lattice, edge);
  if (length <= quanta.longest_measurable()) return;  // not for NaN
  const Spring& spring = lattice.springs[edge];
  const LatticeObject& object = lattice.objects[lattice.point_object[spring.a]];
  throw SimulationError(
      {object.authored.name + ": edge " + std::to_string(edge - object.edges.begin),
       "its spring is " + std::to_string(length / spring.rest_length) +
           " times as long as at rest: the object has been torn apart numerically",
       "use a smaller step (step scale below 1), or springs in double precision if it is meant to "
       "stretch so far"});
}

}  // namespace limber
