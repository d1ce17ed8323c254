#pragma once

#include <span>

#include "core/model/physical_model.h"

namespace limber {

// Upper bound on the highest angular frequency of the undeformed lattice, rad/s.
struct FrequencyBound {
  double omega_max = 0.0;  // never below the true value
  bool verified = false;   // and at most about 5 % above it; else the bound by elements, 20 to 65 %
};

// K v = omega^2 M v over all unbroken edges. A few power iterations find an estimate, a sparse
// factorisation of (1.02 omega)^2 M - K proves that nothing lies above it (it is positive definite
// exactly then). The factorisation of a solid block grows with the square of its points: 0.3 s for
// 1000, 3 s for 2700 (0.3 s for a shell of 2600); models of more than `most_verified` points get
// the bound of element_bound.h at once.
FrequencyBound highest_frequency(const PhysicalModel& model, std::size_t most_verified = 3000);

// Largest stable step of semi-implicit Euler with damping from the old velocities, s:
// (2 / omega) (sqrt(1 + zeta^2) - zeta). A lattice without springs has no limit: infinity.
double stable_step(double omega_rad_s, double damping_ratio);

}  // namespace limber
