#pragma once

#include <cstdint>
#include <vector>

#include "bullet_bridge/shapes/triangle_patch.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// What stands out of triangles and may pass between the points of a lattice: a corner with all
// triangles around it, or a ridge between two. It lies in the polyhedron around its own corners;
// the sides of that beside the triangles are within the body, and nothing comes in through them.
struct SharpCorner {
  std::int64_t key;           // the same in every tick
  std::vector<Vec3> corners;  // m
  Vec3 facing;                // out of the body, of any length
};

// Of the fronts of the triangles: a mesh that is wound inside out has none, nor has the rim of one
// that is open. Corners are convex and have triangles that face more than 60 degrees apart: what is
// less sharp sinks in between points by a third of their spacing at the most. Ridges are those
// edges of that kind that no such corner has.
std::vector<SharpCorner> sharp_corners(const TrianglePatch& patch);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
