#pragma once

#include <vector>

#include "core/modeller/cubic_lattice.h"
#include "tests/reference/build.h"

namespace limber::reference {

// "points", "a", "k1", "k2", "k3", "m" (1 kg without it) and "variant" (uniform without it) of a
// case, with the first point at the origin.
CubicLattice cubic_of(const Json& params);

// Where points are in a cubic lattice.
PointId point_of(const CubicLattice& shape, int ix, int iy, int iz);
int layer_of(const CubicLattice& shape, PointId point, int axis);  // its index along the axis
std::vector<PointId> layer_points(const CubicLattice& shape, int axis, int layer);  // ascending

Mat3 mat3(const Json& rows);
Json to_json(const std::vector<Vec3>& vectors);

}  // namespace limber::reference
