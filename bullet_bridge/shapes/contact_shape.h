#pragma once

#include <vector>

#include "bullet_bridge/shapes/contact_part.h"

class btCollisionShape;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

class ShapeCache;

// The parts of a shape, compounds flattened, that may be met in a tick: those that reach into the
// box from `low` to `high` (in the frame of the shape, m), in the same order in every tick; of
// meshes and height fields the triangles there, followed by the sharp corners cut out of them. To
// be called once a tick. Dear data (planes of hulls) come from the cache. Throws SimulationError
// for shapes that Bullet itself cannot collide with, and for its distance fields from files.
std::vector<ContactPart> contact_parts(const btCollisionShape& shape, const Vec3& low,
                                       const Vec3& high, ShapeCache& cache);

// May the point (in the frame of the whole shape) touch the part after a way of `reach`? By bounds
// alone; infinitely many points of a plane are told apart by their distance.
bool within_reach(const ContactPart& part, const Vec3& point, double reach);

// `point` in the frame of the whole shape, m.
Penetration penetration(const ContactPart& part, const Vec3& point);

// Of a box centred at the origin: inside, the way out through the nearest side.
Penetration box_penetration(const Vec3& half_extents, const Vec3& point);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
