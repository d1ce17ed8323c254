#pragma once

#include "core/model/physical_model.h"

namespace limber {

// Stiffness of an infinitely long prism made of equal layers of points along z.
struct PrismSection {
  double axial = 0.0;          // EA, N
  double bending = 0.0;        // EI for bending in the xz plane about the mean x of the layer's
                               // points, N m^2
  double torsion = 0.0;        // GJ, N m^2
  double poisson_ratio = 0.0;  // of the width: how much the mean positions of the two outermost
                               // rows of points across x draw together, over width and axial strain
};

// From a lattice of at least three layers of points at z = z0, z0 + a, z0 + 2a ...: takes the
// springs of a middle layer, in it and to the layers above, imposes a uniform stretch, curvature or
// twist, and lets the layer warp (the same in every layer) until its energy is least. Linear, about
// the undeformed state: rest lengths and pins do not count. Dense, for layers of up to about 400
// points. Throws InputError for a spacing that is not above 0, too few layers, and a spring whose
// far end has no counterpart in the middle layer.
PrismSection prism_section(const PhysicalModel& bar, double layer_spacing_m);

}  // namespace limber
