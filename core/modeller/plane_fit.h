#pragma once

#include <Eigen/Core>
#include <span>

#include "core/model/vec3.h"

namespace limber {

// Internal to the attribute modellers of sheets: the x >= 0 for which
//   sum_e x_e n_i n_j n_k n_l is nearest to (3/8) (d_ij d_kl + d_ik d_jl + d_il d_jk)
// in the plane across `normal`; n_e are unit vectors along `directions` as seen in it. The smallest
// x where several are.
Eigen::VectorXd isotropic_plane_fit(std::span<const Vec3> directions, const Vec3& normal);

}  // namespace limber
