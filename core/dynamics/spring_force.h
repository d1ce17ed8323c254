#pragma once

#include <cmath>

#include "core/model/vec3.h"

namespace limber {

// State of one spring between the points a and b.
struct SpringStretch {
  Vec3 direction;  // unit vector from a to b; zero for coincident points
  double stretch;  // L - L0, m
  double rate;     // d(L)/dt, m/s
};

// d = x_b - x_a, w = v_b - v_a.
inline SpringStretch spring_stretch(const Vec3& d, const Vec3& w, double rest_length) {
  const double length = std::sqrt(d.dot(d));
  const double inverse = length > 0.0 ? 1.0 / length : 0.0;
  const Vec3 n = d * inverse;
  return {n, length - rest_length, w.dot(n)};
}

// Tension of a damped spring, N, positive when it pulls: T = k (L - L0) + c dL/dt. The force on a
// is +T n, on b -T n: along the edge, so that rigid rotation is not damped (paper, section 5.1).
inline double spring_tension(double stiffness, double damping, double stretch, double rate) {
  return stiffness * stretch + damping * rate;
}

// Elastic energy, J.
inline double spring_energy(double stiffness, double stretch) {
  return 0.5 * stiffness * stretch * stretch;
}

}  // namespace limber
