#pragma once

#include <cstddef>

#include "core/dynamics/lattice.h"

namespace limber {

// What a lattice occupies, bytes, by what needs it. Room that containers keep in reserve does not
// count.
struct MemoryUse {
  std::size_t points = 0;     // motion, forces, masses, roles, contact
  std::size_t springs = 0;    // all of them, their active copies and the links from points to them
  std::size_t breaking = 0;   // links between edges, cells and faces; what is broken and seen
  std::size_t authored = 0;   // the models as they were added

  std::size_t total() const { return points + springs + breaking + authored; }
};

MemoryUse memory_use(const Lattice& lattice);

}  // namespace limber
