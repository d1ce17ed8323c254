#include "bullet_bridge/shapes/contact_shape.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <optional>
#include <utility>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/shapes/convex_distance.h"
#include "bullet_bridge/shapes/shape_cache.h"
#include "bullet_bridge/shapes/shape_part.h"
#include "bullet_bridge/shapes/triangle_patch.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

bool overlap(const Bounds& a, const Bounds& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

int count_parts(const btCollisionShape& shape) {
  if (!shape.isCompound()) return 1;
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  int count = 0;
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    count += count_parts(*compound.getChildShape(i));
  }
  return count;
}

struct Collector {
  const Bounds& region;
  ShapeCache& cache;
  std::vector<ContactPart> parts;
  std::int32_t next_id = 0;

  void add(const btCollisionShape& shape, const btTransform& pose) {
    if (shape.isCompound()) {
      add_children(static_cast<const btCompoundShape&>(shape), pose);
      return;
    }
    const std::int32_t id = next_id++;
    std::optional<ContactPart> part = shape_part(shape, pose, region, cache);
    if (!part || !overlap({part->low, part->high}, region)) return;
    part->id = id;
    parts.push_back(std::move(*part));
    if (parts.back().kind == ContactPart::Kind::kTriangles) add_sharp_parts();
  }

  void add_sharp_parts() {
    for (ContactPart& sharp : sharp_parts(parts.back(), cache)) {
      if (overlap({sharp.low, sharp.high}, region)) parts.push_back(std::move(sharp));
    }
  }

  void add_children(const btCompoundShape& compound, const btTransform& pose) {
    for (int i = 0; i < compound.getNumChildShapes(); ++i) {
      const btCollisionShape& child = *compound.getChildShape(i);
      const btTransform child_pose = pose * compound.getChildTransform(i);
      btVector3 low, high;
      child.getAabb(child_pose, low, high);
      if (overlap({from_bullet(low), from_bullet(high)}, region)) {
        add(child, child_pose);
      } else {
        next_id += count_parts(child);
      }
    }
  }
};

}  // namespace

std::vector<ContactPart> contact_parts(const btCollisionShape& shape, const Vec3& low,
                                       const Vec3& high, ShapeCache& cache) {
  const Bounds region{low, high};
  Collector collector{region, cache, {}, 0};
  collector.add(shape, btTransform::getIdentity());
  return std::move(collector.parts);
}

ContactPart placed(ContactPart part, const Vec3& position, const Mat3& rotation) {
  part.position = position + rotation * part.position;
  part.rotation = rotation * part.rotation;
  part.rotated = !part.rotation.isIdentity(0.0);
  set_bounds(part);
  return part;
}

Penetration penetration(const ContactPart& part, const Vec3& point) {
  const Vec3 own = part.to_part_frame(point);
  Penetration result;
  if (part.kind == ContactPart::Kind::kPlane) {
    result = {part.plane_offset - part.plane_normal.dot(own), part.plane_normal};
  } else if (part.kind == ContactPart::Kind::kTriangles) {
    result = part.triangles->penetration(own, part.margin);
  } else {
    result = convex_penetration(part, own);
  }
  result.normal = part.direction_from_part_frame(result.normal);
  return result;
}

bool within_reach(const ContactPart& part, const Vec3& point, double reach) {
  if (part.kind == ContactPart::Kind::kPlane) return penetration(part, point).depth >= -reach;
  return (point.array() >= part.low.array() - reach).all() &&
         (point.array() <= part.high.array() + reach).all();
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
