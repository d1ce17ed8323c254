#pragma once

#include <span>

#include "core/dynamics/lattice.h"

namespace limber {

// Calls visit(spring) for the unbroken springs of these points, each once: by its point a. In the
// order of the points, then of their edges, so that sums are the same to the bit every time.
template <class Visit>
void for_each_live_spring(const Lattice& lattice, std::span<const std::int32_t> points,
                          Visit visit) {
  for (std::int32_t p : points) {
    for (std::int32_t e : lattice.point_edges[p]) {
      const Spring& s = lattice.springs[e];
      if (s.a == p && !lattice.breaking.edge_broken[e]) visit(s);
    }
  }
}

// How much longer than at rest the spring is now, m.
inline double stretch_of(const Lattice& lattice, const Spring& s) {
  return (lattice.motion[s.b].position - lattice.motion[s.a].position).norm() - s.rest_length;
}

}  // namespace limber
