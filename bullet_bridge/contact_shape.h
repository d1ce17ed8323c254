#pragma once

#include <cmath>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

class btCollisionShape;
class btConvexShape;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// How deep a point lies in a shape.
struct Penetration {
  double depth = 0.0;  // m, negative outside
  Vec3 normal;         // unit, out of the shape
};

// One convex part of a collision shape, asked for single points. Boxes, spheres and planes are
// analytic; any other convex shape goes through Bullet's own query (about 2 us a point).
struct ContactPart {
  enum class Kind { kBox, kSphere, kPlane, kConvex };
  Kind kind;
  Vec3 half_extents;          // box, m
  double radius = 0.0;        // sphere, m
  Vec3 plane_normal;          // plane: n . x = offset
  double plane_offset = 0.0;  // m
  const btConvexShape* convex = nullptr;
  Vec3 position = Vec3::Zero();  // of the part in the frame of the whole shape, m
  Mat3 rotation = Mat3::Identity();
  bool rotated = false;  // spares most parts a matrix product

  Vec3 to_part_frame(const Vec3& point) const {
    if (!rotated) return point - position;
    return rotation.transpose() * (point - position);
  }
};

// The parts of a shape; compounds are flattened. Throws SimulationError for concave shapes, which
// this version cannot collide with lattices.
std::vector<ContactPart> contact_parts(const btCollisionShape& shape);

// The part as it is when the whole shape is placed at a pose.
ContactPart placed(ContactPart part, const Vec3& position, const Mat3& rotation);

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
    case ContactPart::Kind::kConvex:
      break;
  }
  return penetration(part, point).depth >= 0.0;
}

// Of a box centred at the origin: inside, the way out through the nearest side.
Penetration box_penetration(const Vec3& half_extents, const Vec3& point);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
