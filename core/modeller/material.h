#pragma once

#include <string>

#include "core/model/physical_model.h"

namespace limber {

// An isotropic material in SI. A lattice of central forces has Poisson ratio 1/4, whatever is
// meant: modelling_notes() says what that costs.
struct Material {
  double density = 0.0;                   // kg/m^3
  double youngs_modulus = 0.0;            // Pa, of the real material
  double poisson_ratio = 0.25;            // of the real material; asked for by nothing but reports
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

// Throws InputError, which begins with `where`, for a value out of range.
void require_valid(const Material& material, const std::string& where);

// The speed, m/s, at which a bar that hits an equal one, or lands on what does not give way,
// strains to the breaking point: strain at break x sqrt(modulus / density), of the effective values
// (Kolsky, Stress Waves in Solids, 1953: the front's strain is v / c). The same for every S.
double critical_impact_speed(const Material& material);

// Sets c = (2 zeta / omega_max) k on every edge, omega_max by highest_frequency(): a mode of
// frequency omega is damped with the ratio zeta omega / omega_max. Call it again after gluing, when
// omega_max is that of the whole, and after stiffness or mass was changed by hand.
void set_stiffness_proportional_damping(PhysicalModel& model, double damping_ratio);

// The physical attribute modeller for solids: masses, spring and damping constants and thresholds,
// per cell from its shape and size, summed over the cells that share an edge or a point. Damping is
// proportional to stiffness as above. For parts of different materials, and for values of single
// edges, see material_assignment.h.
// Throws InputError when a value is out of range or a cell has no positive volume.
PhysicalModel with_material(GeometricModel geometry, std::string name, const Material& material);

}  // namespace limber
