#pragma once

#include <array>
#include <string>

#include "core/model/physical_model.h"

namespace limber {

// Spring constants of a cubic lattice, N/m. 0: those edges are not made.
struct CubicSprings {
  double axial = 0.0;          // k1, along the axes
  double face_diagonal = 0.0;  // k2, both diagonals of every square
  double body_diagonal = 0.0;  // k3, all four of every cube
};

// How edges and points at the surface are made.
enum class CubicSurface {
  kUniform,  // every edge once with full k, every point with the full mass: simple, a stiff skin
  kShared,   // sums of equal cells (k1/4, k2/2, k3, m/8 each): a surface of half edges, as
             // elasticity theory has it
};

struct CubicLattice {
  std::array<int, 3> points = {2, 2, 2};  // per axis; 1 makes a sheet, a rope or a particle
  double spacing = 1.0;                   // m
  Vec3 origin = Vec3::Zero();             // m, the lowest corner
  CubicSprings springs;
  CubicSurface surface = CubicSurface::kUniform;
  double mass = 1.0;                   // kg, of an inner point
  double damping_per_stiffness = 0.0;  // s, c / k of every edge
  std::string name = "lattice";
};

// Points in x-fastest order, one subobject. Cells are cubes, in a sheet squares (2-D cells); a rope
// and a particle have none. In a sheet or rope kShared sums over squares (k1/2, k2, m/4) or
// segments (k1, m/2). Faces of cubes look outwards, those of a sheet along the axis it has one
// point on. Where the springs leave no legal cell (G6), there are neither cells nor faces: without
// any spring, and in a sheet without axial ones. All attributes that are not asked for have their
// defaults; nothing breaks. Throws InputError for a number of points, a spacing, mass or stiffness
// out of range.
PhysicalModel cubic_lattice(const CubicLattice& lattice);

}  // namespace limber
