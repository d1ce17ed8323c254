#pragma once

#include <btBulletCollisionCommon.h>

#include <vector>

#include "core/model/vec3.h"

// Rigid shapes as their authors mean them, in closed forms of their own: none of the bridge's.

namespace limber::bullet::test {

// m, how far the point lies inside the shape from its nearest surface; zero or less outside. Under
// a concave shape, which has to be a floor: from the triangle above it, along this one's normal.
// Throws std::invalid_argument for shapes that no scene has.
double depth_inside(const btCollisionShape& shape, const Vec3& local_point);

// Points of the shape that enter a lattice before others do: all over what is thin or small, at
// most `spacing` m apart along edges and axes. None of a concave shape.
std::vector<Vec3> probes_of(const btCollisionShape& shape, double spacing);

}  // namespace limber::bullet::test
