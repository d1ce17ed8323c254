#pragma once

#include <numbers>
#include <span>
#include <vector>

#include "core/model/rounded_cache.h"
#include "core/model/vec3.h"

namespace limber {

// Spring constants (N/m) that make the cell as nearly isotropic with the given modulus as its edges
// allow: non-negative least squares on the fully symmetric elasticity tensor
// C_ijkl = sum_e k_e l_e^2 n_i n_j n_k n_l / V = (2/5) E (d_ij d_kl + d_ik d_jl + d_il d_jk),
// with the smoothest solution where several fit. `edges_m` are the edge vectors.
std::vector<double> isotropic_cell_stiffness(std::span<const Vec3> edges_m, double volume_m3,
                                             double youngs_modulus_Pa);

// Largest deviation of a component of the cell's elasticity tensor from the isotropic one, relative
// to C_1111 = 1.2 E.
double anisotropy(std::span<const Vec3> edges_m, std::span<const double> stiffness_N_m,
                  double volume_m3, double youngs_modulus_Pa);

// Spring constants of a shape whatever its material: k_e = weight_e 6 E V / trace.
struct CellFit {
  std::vector<double> weights;  // shape (edges)
  double trace = 0.0;           // m^2, sum of weight_e l_e^2

  double stiffness_per_weight(double volume_m3, double youngs_modulus_Pa) const;  // N/m
};

// The same fit for many cells: congruent ones with the same order of edges, of which a regular
// lattice is made, are fitted once.
class CellFitter {
 public:
  // The reference holds until the next call.
  const CellFit& fit(std::span<const Vec3> edges_m);

 private:
  RoundedKey key_;
  RoundedCache<CellFit> fits_;
};

// Replaces `key` by that of the shape.
void set_shape_key(std::span<const Vec3> edges_m, RoundedKey& key);

// Length over width: root of the ratio of the largest to the smallest second moment of the corners,
// for a box that of its longest to its shortest side. Infinite for what is flat.
double elongation(std::span<const Vec3> corners_m);

// Up to here a box with sides a >= b >= c and all 28 edges can be isotropic. From C_iijj = (2/5) E
// follow the face diagonals' springs; C_1111 = (6/5) E then leaves the long edges, with K = k / L^2
// of a body diagonal (length L), k a^2 / (E V) = 1.2 - 0.4 (a^2/b^2 + a^2/c^2) + 4 K a^4 / (E V).
// The diagonals of the largest face bound K, 4 K <= 0.4 E V / (a^2 b^2), so that at best
// k a^2 / (E V) = 1.2 - 0.4 a^2 / c^2: negative beyond a = sqrt(3) c. Without body diagonals (K =
// 0) the limit is a^2/b^2 + a^2/c^2 = 3, sqrt(3/2) for a square section.
inline constexpr double kLongestIsotropicBox = std::numbers::sqrt3;

}  // namespace limber
