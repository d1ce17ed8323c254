#pragma once

#include <span>

#include "core/dynamics/components.h"

namespace limber {

// Draws the points of each piece towards the piece's own rigid motion:
// v_i += (1 - exp(-gamma t)) (v + omega x r_i - v_i), with gamma of the piece's object, 1/s.
// The rigid motion has the P and L of the points, so that both are kept exactly; what is lost is
// the share 1 - exp(-2 gamma t) of the vibration's kinetic energy. Returns that loss, J.
//
// `lead`, s, one for each object, or none: positions are ahead of velocities by this. Symplectic
// Euler's are by dt / 2. Velocities then are damped where the points were when they had them, and
// positions follow: with z = omega dt, (1 - z^2/4) v^2 + omega^2 (x - v dt/2)^2, which the
// integrator keeps, can only fall. Without it strong damping feeds vibrations near the limit.
double damp_internally(Lattice& lattice, const Components& pieces, double t,
                       std::span<const double> lead = {});

}  // namespace limber
