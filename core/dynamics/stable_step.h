#pragma once

#include <span>

#include "core/model/physical_model.h"

namespace limber {

// Upper bound on the highest angular frequency of the model as it is, and on its way back to its
// rest lengths where it is compressed or collapsed, rad/s.
struct FrequencyBound {
  double omega_max = 0.0;  // never below the true value
  // And 0.5 % above it as a rule. Else the bound by blocks of a grid, 1 %, or by elements, 20 to 65
  // %.
  bool verified = false;
};

// K v = omega^2 M v over all unbroken edges. Lanczos's method finds an estimate omega, a sparse
// factorisation of (1.005 omega)^2 M - K proves that nothing lies above it (it is positive definite
// exactly then). Factors of more than `most_entries` are not computed: a shell of 3400 points fills
// 0.9 million (0.2 s), a solid block of 1700 points 1.6 million (0.3 s), one of 2700 points 3.1
// million (0.9 s), and the time grows with the square; larger models get the bound of
// block_bound.h or element_bound.h.
FrequencyBound highest_frequency(const PhysicalModel& model, std::size_t most_entries = 3500000);

// The same of every shape that the springs may take, stretched and turned in any way: the tangent
// stiffness of a spring, k n n^T + k (1 - L0 / L) (I - n n^T), is at most k I. 1 to sqrt(3) times
// highest_frequency(), and as much as it may come to where the model folds: a cube of axial springs
// alone shears until they all point one way.
FrequencyBound large_strain_bound(const PhysicalModel& model);

// Largest stable step of semi-implicit Euler with damping from the old velocities, s:
// (2 / omega) (sqrt(1 + zeta^2) - zeta). A lattice without springs has no limit: infinity.
double stable_step(double omega_rad_s, double damping_ratio);

}  // namespace limber
