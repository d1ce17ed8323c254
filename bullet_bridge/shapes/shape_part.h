#pragma once

#include <optional>
#include <vector>

#include "bullet_bridge/shapes/contact_part.h"

class btCollisionShape;
class btTransform;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

class ShapeCache;

struct Bounds {
  Vec3 low, high;  // m
};

// The bounds of what is within bounds in a frame that is placed and turned.
Bounds turned(const Bounds& box, const Vec3& position, const Mat3& rotation);

// The part's bounds in the whole shape's frame, and its tolerance, from those in its own.
void set_bounds(ContactPart& part);

// A shape that is no compound as a part at a pose in the whole shape; of a mesh or height field the
// triangles in `region` of the whole shape. None where there is nothing to touch.
std::optional<ContactPart> shape_part(const btCollisionShape& shape, const btTransform& pose,
                                      const Bounds& region, ShapeCache& cache);

// What stands out of a part made of triangles, cut out for faces alone.
std::vector<ContactPart> sharp_parts(const ContactPart& triangles, ShapeCache& cache);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
