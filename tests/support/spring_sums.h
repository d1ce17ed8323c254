#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/dynamics/spring_forces.h"

namespace limber::test {

// What SpringForces makes of a lattice.
struct SpringSums {
  std::vector<Vec3> force;  // shape (P), N
  std::vector<std::int32_t> overstretched;
  SpringForces::Paths paths;
};

inline SpringSums added_by(SpringForces& springs, Lattice& lattice) {
  std::fill(lattice.force.begin(), lattice.force.end(), Vec3::Zero());
  springs.add(0.0);
  const auto edges = springs.overstretched_edges();
  return {lattice.force, {edges.begin(), edges.end()}, springs.paths()};
}

// The reference: one edge after the other, in double precision.
inline SpringSums in_double(Lattice lattice) {
  SpringForces springs(lattice, SpringPrecision::kDouble);
  return added_by(springs, lattice);
}

// Fails the test where springs are on no grid.
inline SpringSums in_single(Lattice lattice) {
  SpringForces springs(lattice, SpringPrecision::kSingle);
  const SpringSums sums = added_by(springs, lattice);
  EXPECT_EQ(sums.paths.grids, lattice.active.size());
  return sums;
}

}  // namespace limber::test
