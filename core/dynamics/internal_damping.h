#pragma once

#include "core/dynamics/components.h"

namespace limber {

// Draws the points of each piece towards the piece's own rigid motion:
// v_i += (1 - exp(-gamma t)) (v + omega x r_i - v_i), with gamma of the piece's object, 1/s.
// The rigid motion has the P and L of the points, so that both are kept exactly; what is lost is
// the share 1 - exp(-2 gamma t) of the vibration's kinetic energy. Returns that loss, J.
double damp_internally(Lattice& lattice, const Components& pieces, double t);

}  // namespace limber
