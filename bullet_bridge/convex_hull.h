#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/contact/half_space.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// How many directions outermost() looks in.
inline constexpr int kSupportDirections = 98;

// Which points stick out farthest in one of 98 directions, ascending: those from the centre of a
// cube to the points of a 5 x 5 x 5 grid on its surface. The hull of those of a fine ball lies up
// to 6 % of its radius inside it; what has fewer corners than that keeps them but for the dullest.
std::vector<std::int32_t> outermost(std::span<const Vec3> points);

struct ConvexHull {
  std::vector<Vec3> corners;     // m
  std::vector<HalfSpace> sides;  // each touches the hull, and all of it lies within
  double volume = 0.0;           // m^3

  // m, of its sides from the mean of its corners, at least: 0 for what is flat.
  double inner_radius() const;
};

// Of a few dozen points. Corners are some of them, to the bit.
ConvexHull convex_hull(std::span<const Vec3> points);

// Its corners, each moved to the nearest place that is `depth` (m, less than the inner radius)
// behind all sides; those that meet there are one. A ball of that radius about it touches all sides
// of a corner where three meet, as those of a box do. Where more meet it touches those that turn
// away most from one another and stays behind the others: nothing ever sticks out. Rejected: the
// exact inset, which has a corner for every three of them. Bullet's takes ten times as long and
// gives four times the corners, each of which costs in every tick; the points of 900 random pieces
// stick out of its balls by 0.016 depths less on average, 0.6 at most.
std::vector<Vec3> inset_corners(const ConvexHull& hull, double depth);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
