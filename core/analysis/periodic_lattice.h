#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/model/physical_model.h"

namespace limber {

// An infinite lattice with one point a cell: what the inside of a regular block is made of.
struct PeriodicLattice {
  struct Bond {
    Vec3 offset;             // m, from a point to its neighbour; each pair of directions once
    double stiffness = 0.0;  // N/m
  };
  double cell_volume = 0.0;  // m^3
  std::vector<Bond> bonds;
};

// What surrounds one inner point of a block, continued for ever. Throws InputError unless every
// unbroken spring of the point has an equal one that goes the opposite way.
PeriodicLattice lattice_around(const PhysicalModel& block, PointId inner, double cell_volume_m3);

// Elasticity matrix in Voigt's notation (xx, yy, zz, yz, xz, xy; engineering shear), Pa:
// C_ijkl = sum_bonds k l^2 n_i n_j n_k n_l / V (Born and Huang, Dynamical Theory of Crystal
// Lattices, 1954). About the undeformed state.
using ElasticityMatrix = Eigen::Matrix<double, 6, 6>;
ElasticityMatrix elasticity(const PeriodicLattice& lattice);

// D(q) = sum_bonds 2 k (1 - cos q . d) n n^T, N/m: omega^2 m are its eigenvalues for a plane wave
// of wave vector q (rad/m).
Mat3 dynamical_matrix(const PeriodicLattice& lattice, const Vec3& wave_vector);

struct PlaneWave {
  double omega = 0.0;               // rad/s
  Vec3 wave_vector = Vec3::Zero();  // rad/m
};

// The fastest plane wave of a cubic lattice whose offsets are multiples of `spacing_m` along the
// axes; m is the mass of a point. A grid over the Brillouin zone finds where to look, a compass
// search improves it to about 1e-12 of omega. Finite free blocks stay below it.
PlaneWave highest_bulk_frequency(const PeriodicLattice& lattice, double mass_kg, double spacing_m);

}  // namespace limber
