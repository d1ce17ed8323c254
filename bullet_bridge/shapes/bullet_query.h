#pragma once

#include "bullet_bridge/shapes/contact_part.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// Bullet's own query for any convex shape (GJK, and EPA where it overlaps), in the shape's frame: 2
// us and more a point, and in float32 right to about 1e-4 of the shape's size.
Penetration bullet_penetration(const btConvexShape& shape, const Vec3& point);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
