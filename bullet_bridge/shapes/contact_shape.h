#pragma once

#include <cmath>
#include <vector>

#include "bullet_bridge/shapes/contact_part.h"

class btCollisionShape;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// The parts of a shape; compounds are flattened. Throws SimulationError for concave shapes, which
// this version cannot collide with lattices.
std::vector<ContactPart> contact_parts(const btCollisionShape& shape);

class ShapeCache;

// The parts of a shape that may be met in a tick: those that reach into the box from `low` to
// `high` (in the frame of the shape, m), ascending by id; of meshes and height fields the triangles
// there. To be called once a tick. Dear data (planes of hulls) come from the cache. Throws
// SimulationError for shapes that Bullet itself cannot collide with, and for its distance fields
// from files.
std::vector<ContactPart> contact_parts(const btCollisionShape& shape, const Vec3& low,
                                       const Vec3& high, ShapeCache& cache);

// May the point (in the frame of the whole shape) touch the part after a way of `reach`? By bounds
// alone; infinitely many points of a plane are told apart by their distance.
bool within_reach(const ContactPart& part, const Vec3& point, double reach);

// `point` in the frame of the whole shape, m.
Penetration penetration(const ContactPart& part, const Vec3& point);

// Does the point lie in the shape? Costs a fraction of penetration() for the many points that are
// near a body without touching it.
inline bool contains(const ContactPart& part, const Vec3& point) {
  const Vec3 local = part.to_part_frame(point);
  switch (part.kind) {
    case ContactPart::Kind::kBox:
      return std::abs(local.x()) <= part.half_extents.x() &&
             std::abs(local.y()) <= part.half_extents.y() &&
             std::abs(local.z()) <= part.half_extents.z();
    case ContactPart::Kind::kSphere:
      return local.squaredNorm() <= part.radius * part.radius;
    case ContactPart::Kind::kPlane:
      return part.plane_normal.dot(local) <= part.plane_offset;
    default:
      return penetration(part, point).depth >= 0.0;
  }
}

// Of a box centred at the origin: inside, the way out through the nearest side.
Penetration box_penetration(const Vec3& half_extents, const Vec3& point);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
