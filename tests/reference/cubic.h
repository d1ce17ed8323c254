#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/analysis/periodic_lattice.h"
#include "core/modeller/cubic_lattice.h"
#include "tests/reference/json_values.h"

namespace limber::reference {

// "points" (2 x 2 x 2 without it), "a", "k1", "k2", "k3" (0 without them), "m" (1 kg without it),
// "beta" = c / k and "variant" (uniform without it) of a case, with the first point at the origin.
CubicLattice cubic_of(const Json& params);

// The lattice itself, without contact between its points.
PhysicalModel cubic_model(const CubicLattice& shape);
PhysicalModel cubic_model(const Json& params);

// Where points are in it.
PointId point_of(const CubicLattice& shape, const std::array<int, 3>& at);
int layer_of(const CubicLattice& shape, PointId point, int axis);  // its index along the axis
std::vector<PointId> layer_points(const CubicLattice& shape, int axis, int layer);  // ascending

// "axial", "face" or "body": which way an edge of this rest length goes.
std::string family_of(double rest_length, double spacing);

// What the inside is made of, continued for ever, and its elasticity.
struct Bulk {
  PeriodicLattice lattice;
  ElasticityMatrix stiffness;  // Pa
  double density = 0.0;        // kg/m^3
};
Bulk bulk_of(CubicLattice shape);

// Of long plane waves that feel this entry of the elasticity matrix (Pa), m/s.
double wave_speed(double modulus, double density);

}  // namespace limber::reference
