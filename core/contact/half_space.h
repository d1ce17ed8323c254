#pragma once

#include <span>

#include "core/model/vec3.h"

namespace limber {

// The places x with normal . x <= distance. The normal has unit length and looks outwards.
struct HalfSpace {
  Vec3 normal = Vec3::UnitY();
  double distance = 0.0;  // m, of its plane from the origin

  // m: positive outside.
  double excess(const Vec3& place) const { return normal.dot(place) - distance; }
};

// The place nearest to `from` that lies in all half-spaces, to within `slack` (m). What they have
// in common must not be empty. At most three of their planes hold it: they are exchanged, the one
// that is missed by most coming in, which moves it farther from `from` each time (an LP-type
// problem: Sharir and Welzl 1992).
Vec3 nearest_within(const Vec3& from, std::span<const HalfSpace> half_spaces, double slack);

}  // namespace limber
