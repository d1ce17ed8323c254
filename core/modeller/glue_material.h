#pragma once

#include "core/modeller/material.h"
#include "core/operators/gluing_operator.h"

namespace limber {

// Glue that carries tension across a gap as this material would: each bond, straight across, stands
// for a rod of k = E A / L, with the area of the seam it has to itself (spacing^2 on a square grid)
// and the gap as its length; breaks and crushes at the material's strains, softened as it says.
// The bond reaches exactly across the gap. Such bonds resist being pulled apart and hardly being
// shifted sideways: raise `distance` past the diagonals, sqrt(gap^2 + spacing^2), for a seam that
// carries shear, and share the stiffness among the bonds that each point then has. Damping stays 0:
// call set_stiffness_proportional_damping() on the glued model. Throws InputError for a material,
// area or gap out of range.
GlueBond bond_like(const Material& material, double area_per_bond_m2, double gap_m);

}  // namespace limber
