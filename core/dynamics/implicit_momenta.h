#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/dynamics/implicit_forces.h"

namespace limber {

// Points of each connected piece that no spring ties to a pinned point, ascending.
std::vector<std::vector<std::int32_t>> free_pieces(const ImplicitSystem& system);

// Moves the piece through a step of dt (s) as the rigid body that has its P and L; velocities are
// those of the straight way there.
void move_rigidly(Lattice& lattice, std::span<const std::int32_t> piece, double dt);

// P and L of a piece, L about its centre of mass.
struct Momenta {
  Vec3 linear = Vec3::Zero();   // kg m/s
  Vec3 angular = Vec3::Zero();  // kg m^2/s
};

// What a piece without supports has at the end of a step, as by semi-implicit Euler: P + dt sum F
// and L + dt sum x x F, with the constant forces at the points of the start.
Momenta earned_momenta(const Lattice& lattice, const ImplicitSystem& system,
                       std::span<const std::int32_t> piece, const ImplicitForces& forces);

// Gives the piece that momentum, by one velocity that all points share and that moves them, too.
void restore_momentum(Lattice& lattice, std::span<const std::int32_t> piece, const Momenta& earned,
                      double dt);

// Gives the piece that angular momentum, by one rotation added to its velocities, as far as the
// budget of energy (J) allows. Returns what it took, J.
double restore_spin(Lattice& lattice, std::span<const std::int32_t> piece, const Momenta& earned,
                    double budget);

}  // namespace limber
