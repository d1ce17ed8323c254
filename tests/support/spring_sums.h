#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

// Sum of the magnitudes of the forces at each point, N: what errors of sums are relative to.
inline std::vector<double> force_scales(const Lattice& lattice) {
  std::vector<double> scale(lattice.motion.size(), 0.0);
  for (const Spring& s : lattice.springs) {
    const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
    const Vec3 w = lattice.motion[s.b].velocity - lattice.motion[s.a].velocity;
    const double force = s.stiffness * std::abs(d.norm() - s.rest_length) + s.damping * w.norm();
    scale[s.a] += force;
    scale[s.b] += force;
  }
  return scale;
}

// The largest difference of two forces on a point, as a share of the point's scale; infinite where
// one is no number.
inline double worst_error(const std::vector<Vec3>& forces, const std::vector<Vec3>& exact,
                          const std::vector<double>& scale) {
  double worst = 0.0;
  for (std::size_t p = 0; p < scale.size(); ++p) {
    const double error = (forces[p] - exact[p]).norm();
    if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
    if (error > 0.0) worst = std::max(worst, error / scale[p]);
  }
  return worst;
}

}  // namespace limber::test
