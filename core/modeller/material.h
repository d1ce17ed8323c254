#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/model/physical_model.h"

namespace limber {

// An isotropic material in SI. A lattice of central forces has Poisson ratio 1/4, whatever is
// meant.
struct Material {
  double density = 0.0;                   // kg/m^3
  double youngs_modulus = 0.0;            // Pa, of the real material
  double strain_at_break = kUnbreakable;  // of the real material, tension
  double strain_at_crush = kUnbreakable;  // of the real material, compression
  double damping_ratio = 0.0;             // of the lattice's highest frequency
  double internal_damping = 0.0;          // 1/s
  double friction = 0.5;
  double restitution = 0.0;
  // S >= 1. The lattice gets modulus / S and strain at break x sqrt(S): what impact speed breaks it
  // (strain x wave speed) stays. Nothing softens silently: S travels in ObjectAttributes.
  double softening = 1.0;

  double effective_modulus() const;  // Pa
  double effective_strain_at_break() const;
  double effective_strain_at_crush() const;
};

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

// Sets c = (2 zeta / omega_max) k on every edge, omega_max by highest_frequency(): a mode of
// frequency omega is damped with the ratio zeta omega / omega_max. Call it again after gluing, when
// omega_max is that of the whole.
void set_stiffness_proportional_damping(PhysicalModel& model, double damping_ratio);

// The physical attribute modeller for solids: masses, spring and damping constants and thresholds,
// per cell from its shape and size, summed over the cells that share an edge or a point. Damping is
// proportional to stiffness as above.
// Throws InputError when a value is out of range or a cell has no positive volume.
PhysicalModel with_material(GeometricModel geometry, std::string name, const Material& material);

}  // namespace limber
