#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/model/geometric_model.h"

namespace limber {

// Points without edges, one for each position (m): grains, drops, smoke. One subobject called
// `name`. Throws InputError for positions that are not finite and for none at all.
GeometricModel particle_cloud(std::span<const Vec3> positions_m, const std::string& name);

// The places of a cubic grid of `spacing_m` in the box between two corners, the grid centred in it
// and no place nearer to a side than half a spacing: grains of that diameter fill the box. In
// x-fastest order. Throw InputError for an empty box, a spacing that is not positive or larger than
// a side, and a spacing so small that there would be too many.
std::vector<Vec3> grid_in_box(const Vec3& low_m, const Vec3& high_m, double spacing_m);

// The places of a cubic grid through the centre that are in the ball of this radius.
std::vector<Vec3> grid_in_sphere(const Vec3& centre_m, double radius_m, double spacing_m);

// Random places in the box, no two nearer than `least_distance_m`, and so dense that there is
// hardly room for more (blue noise: Bridson, Fast Poisson Disk Sampling in Arbitrary Dimensions,
// SIGGRAPH 2007, with 30 tries a place; started anew where it dies out). The same seed gives the
// same places on every machine.
std::vector<Vec3> scattered_in_box(const Vec3& low_m, const Vec3& high_m, double least_distance_m,
                                   std::uint64_t seed);

// The same in the ball.
std::vector<Vec3> scattered_in_sphere(const Vec3& centre_m, double radius_m,
                                      double least_distance_m, std::uint64_t seed);

}  // namespace limber
