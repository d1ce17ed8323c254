#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/model/physical_model.h"
#include "core/modeller/material.h"

namespace limber {

// The physical attribute modellers for what is not solid: ropes, sheets and particles. Materials,
// softening and damping are as for solids (material.h). All throw InputError when a value is out of
// range or the geometry is of another kind.

// m^2, of a round rope.
double round_section(double diameter_m);

// A rope: each edge a segment of the given cross-section (m^2), with half its mass rho A l at each
// end and the spring constant E A / l of a bar (exact for a steady tension). Edges that belong to
// cells are refused.
PhysicalModel with_rope_material(GeometricModel geometry, std::string name,
                                 const Material& material, double section_m2);

// A sheet of 2-D cells. Its springs resist stretch and shear, not bending: see bending_springs.h.
struct SheetProperties {
  double thickness = 0.0;     // m
  FaceAttributes faces = {};  // how all faces resist the air; without drag by default
};

// Masses, spring and damping constants and thresholds per cell from its shape and size, summed over
// the cells that share an edge or a point: rho A t, and isotropic_sheet_stiffness().
PhysicalModel with_sheet_material(GeometricModel geometry, std::string name,
                                  const Material& material, const SheetProperties& sheet);

// Spring constants (N/m) that make a flat cell of this area as nearly isotropic as its edges allow:
// non-negative least squares on the fully symmetric plane tensor
//   A_ijkl = sum_e k_e l_e^2 n_i n_j n_k n_l / area = (3/8) Et (d_ij d_kl + d_ik d_jl + d_il d_jk).
// That is plane stress of a sheet of Young's modulus times thickness Et, N/m, and Poisson ratio
// 1/3: A_1111 = Et / (1 - nu^2), A_1122 = nu A_1111 and A_1212 = Et / (2 (1 + nu)) are symmetric
// (A_1122 = A_1212) exactly for nu = 1/3, then 9/8 Et and 3/8 Et. (A solid of central forces has
// 1/4: its edges run through its thickness too.) The trace A_iijj = 3 Et is exact for every cell.
// Of equilateral triangles each edge gets (sqrt(3)/4) Et from each of its two cells.
// The smallest solution where several fit. `edges_m` are the edge vectors, `normal` is that of the
// cell, of any length: what the edges have along it is left out.
std::vector<double> isotropic_sheet_stiffness(std::span<const Vec3> edges_m, const Vec3& normal,
                                              double area_m2, double modulus_thickness_N_m);

// What every point of a cloud is.
struct Particle {
  double mass = 0.0;    // kg
  double radius = 0.0;  // m, of contact; 0: passes through other points
  double friction = 0.5;
  double restitution = 0.0;
};

// A ball of this density, kg/m^3, and radius, m.
Particle ball_particle(double density_kg_m3, double radius_m);

// A cloud of equal particles. Edges and cells are refused.
PhysicalModel with_particles(GeometricModel geometry, std::string name, const Particle& particle);

}  // namespace limber
