#include "bullet_bridge/shapes/shape_part.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btPolyhedralConvexShape.h>
#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <algorithm>
#include <limits>
#include <string>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/shapes/convex_planes.h"
#include "bullet_bridge/shapes/shape_cache.h"
#include "bullet_bridge/shapes/sharp_corners.h"
#include "bullet_bridge/shapes/triangle_patch.h"
#include "core/model/errors.h"
#include "core/storage/state_hash.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

using Kind = ContactPart::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Distances of closed forms and planes, and those of Bullet's general query, as a share of the
// size.
constexpr double kRounding = 1e-12;
constexpr double kQueryRounding = sizeof(btScalar) == 4 ? 1e-5 : 1e-9;

// Turns the y axis of a part into another axis of its shape.
Mat3 y_turned_to(int axis) {
  Mat3 turn = Mat3::Identity();
  if (axis == 0) turn << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  if (axis == 2) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return turn;
}

void turn(ContactPart& part, const Mat3& rotation) {
  part.rotation = part.rotation * rotation;
  part.rotated = !part.rotation.isIdentity(0.0);
}

void set_own_bounds(ContactPart& part, const Vec3& low, const Vec3& high) {
  part.own_low = low;
  part.own_high = high;
  set_bounds(part);
}

void set_own_bounds(ContactPart& part, const Vec3& half) { set_own_bounds(part, -half, half); }

void make_box(ContactPart& part, const btBoxShape& box) {
  part.kind = Kind::kBox;
  part.half_extents = from_bullet(box.getHalfExtentsWithMargin());
  set_own_bounds(part, part.half_extents);
}

void make_sphere(ContactPart& part, const btSphereShape& sphere) {
  part.kind = Kind::kSphere;
  part.radius = sphere.getRadius();
  set_own_bounds(part, Vec3::Constant(part.radius));
}

void make_plane(ContactPart& part, const btStaticPlaneShape& plane) {
  part.kind = Kind::kPlane;
  part.plane_normal = from_bullet(plane.getPlaneNormal()).normalized();
  part.plane_offset = plane.getPlaneConstant();
  set_own_bounds(part, Vec3::Constant(kInfinity));
}

void make_capsule(ContactPart& part, const btCapsuleShape& capsule) {
  part.kind = Kind::kCapsule;
  part.radius = capsule.getRadius();
  part.half_height = capsule.getHalfHeight();
  turn(part, y_turned_to(capsule.getUpAxis()));
  set_own_bounds(part, {part.radius, part.half_height + part.radius, part.radius});
}

void make_cylinder(ContactPart& part, const btCylinderShape& cylinder) {
  part.kind = Kind::kCylinder;
  const double radius = cylinder.getRadius();
  const double half_height = cylinder.getHalfExtentsWithMargin()[cylinder.getUpAxis()];
  part.margin = std::min({double{cylinder.getMargin()}, radius, half_height});
  part.radius = radius - part.margin;
  part.half_height = half_height - part.margin;
  turn(part, y_turned_to(cylinder.getUpAxis()));
  set_own_bounds(part, {radius, half_height, radius});
}

void make_cone(ContactPart& part, const btConeShape& cone) {
  part.kind = Kind::kCone;
  part.radius = cone.getRadius();
  part.half_height = 0.5 * cone.getHeight();
  part.margin = cone.getMargin();
  turn(part, y_turned_to(cone.getConeUpIndex()));
  const double wide = part.radius + part.margin;
  set_own_bounds(part, {wide, part.half_height + part.margin, wide});
}

// False where the shape has no planes of its own.
bool make_hull(ContactPart& part, const btCollisionShape& shape, ShapeCache& cache) {
  if (!shape.isPolyhedral()) return false;
  part.hull = cache.planes_of(static_cast<const btPolyhedralConvexShape&>(shape));
  if (part.hull == nullptr) return false;
  part.kind = Kind::kHull;
  part.margin = shape.getMargin();
  set_own_bounds(part, part.hull->low().array() - part.margin,
                 part.hull->high().array() + part.margin);
  return true;
}

void make_convex(ContactPart& part, const btConvexShape& shape) {
  part.kind = Kind::kConvex;
  part.convex = &shape;
  btVector3 low, high;
  shape.getAabb(btTransform::getIdentity(), low, high);
  set_own_bounds(part, from_bullet(low), from_bullet(high));
}

struct TriangleCollector : btTriangleCallback {
  std::vector<TrianglePatch::Raw> raw;

  void processTriangle(btVector3* corners, int part, int index) override {
    const std::int64_t key = (std::int64_t{part} << 32) + index;
    raw.push_back(
        {key, {from_bullet(corners[0]), from_bullet(corners[1]), from_bullet(corners[2])}});
  }
};

// The triangles of a height field face upwards, whichever way they are wound.
void face_upwards(std::vector<TrianglePatch::Raw>& raw, int up) {
  for (TrianglePatch::Raw& r : raw) {
    if (twice_area_vector(r.corners)[up] < 0.0) std::swap(r.corners[1], r.corners[2]);
  }
}

void make_triangles(ContactPart& part, const btConcaveShape& shape, const Bounds& region) {
  part.kind = Kind::kTriangles;
  part.concave = &shape;
  part.margin = shape.getMargin();
  const Mat3 back = part.rotation.transpose();
  const Bounds own = turned(region, -(back * part.position), back);
  const Vec3 margin = Vec3::Constant(part.margin);
  TriangleCollector collector;
  shape.processAllTriangles(&collector, to_bullet(own.low - margin), to_bullet(own.high + margin));
  if (shape.getShapeType() == TERRAIN_SHAPE_PROXYTYPE) {
    face_upwards(collector.raw, static_cast<const btHeightfieldTerrainShape&>(shape).getUpAxis());
  }
  auto patch = std::make_shared<TrianglePatch>(std::move(collector.raw), part.margin);
  set_own_bounds(part, patch->low(), patch->high());
  part.triangles = std::move(patch);
}

bool has_triangles(const btCollisionShape& shape) {
  if (!shape.isConcave() || dynamic_cast<const btSdfCollisionShape*>(&shape) != nullptr) {
    return false;
  }
  const auto* impact = dynamic_cast<const btGImpactShapeInterface*>(&shape);
  return impact == nullptr || impact->getGImpactShapeType() != CONST_GIMPACT_COMPOUND_SHAPE;
}

bool make_closed_form(ContactPart& part, const btCollisionShape& shape) {
  const auto made_by = [&]<class Shape>(void (*make)(ContactPart&, const Shape&)) {
    make(part, static_cast<const Shape&>(shape));
    return true;
  };
  switch (shape.getShapeType()) {
    case BOX_SHAPE_PROXYTYPE:
      return made_by(make_box);
    case SPHERE_SHAPE_PROXYTYPE:
      return made_by(make_sphere);
    case STATIC_PLANE_PROXYTYPE:
      return made_by(make_plane);
    case CAPSULE_SHAPE_PROXYTYPE:
      return made_by(make_capsule);
    case CYLINDER_SHAPE_PROXYTYPE:
      return made_by(make_cylinder);
    case CONE_SHAPE_PROXYTYPE:
      return made_by(make_cone);
    default:
      return false;
  }
}

// Of what is cut out of a part: far from the numbers of parts.
std::int64_t id_of(std::int64_t part, std::int64_t key) {
  StateHash hash;
  hash.add(part);
  hash.add(key);
  return static_cast<std::int64_t>(hash.value());
}

}  // namespace

Bounds turned(const Bounds& box, const Vec3& position, const Mat3& rotation) {
  if (!box.low.allFinite() || !box.high.allFinite()) return box;
  const Vec3 centre = position + rotation * (0.5 * (box.low + box.high));
  const Vec3 half = rotation.cwiseAbs() * (0.5 * (box.high - box.low));
  return {centre - half, centre + half};
}

void set_bounds(ContactPart& part) {
  const Bounds outer = turned({part.own_low, part.own_high}, part.position, part.rotation);
  const double size = outer.low.allFinite() ? std::max(outer.low.cwiseAbs().maxCoeff(),
                                                       outer.high.cwiseAbs().maxCoeff())
                                            : 1.0;
  part.tolerance = size * (part.kind == Kind::kConvex ? kQueryRounding : kRounding);
  part.low = outer.low.array() - part.tolerance;
  part.high = outer.high.array() + part.tolerance;
}

std::optional<ContactPart> shape_part(const btCollisionShape& shape, const btTransform& pose,
                                      const Bounds& region, ShapeCache& cache) {
  ContactPart part;
  part.position = from_bullet(pose.getOrigin());
  turn(part, from_bullet(pose.getRotation()).toRotationMatrix());
  if (shape.getShapeType() == EMPTY_SHAPE_PROXYTYPE) return std::nullopt;
  if (make_closed_form(part, shape) || make_hull(part, shape, cache)) return part;
  if (shape.isConvex()) {
    make_convex(part, static_cast<const btConvexShape&>(shape));
    return part;
  }
  if (!has_triangles(shape)) {
    throw SimulationError({std::string("collision shape ") + shape.getName(),
                           "a flexible body has come near a shape of a kind it cannot touch",
                           "build it from convex shapes, triangle meshes and height fields"});
  }
  make_triangles(part, static_cast<const btConcaveShape&>(shape), region);
  if (part.triangles->triangles().empty()) return std::nullopt;
  return part;
}

std::vector<ContactPart> sharp_parts(const ContactPart& triangles, ShapeCache& cache) {
  std::vector<ContactPart> parts;
  for (SharpCorner& corner : sharp_corners(*triangles.triangles)) {
    ContactPart part = triangles;
    part.triangles = nullptr;
    part.hull = cache.planes_around(std::move(corner.corners), part.margin);
    if (part.hull == nullptr) continue;  // as thin as rounding
    part.kind = Kind::kHull;
    part.id = id_of(triangles.id, corner.key);
    part.for_faces = true;
    part.facing = corner.facing;
    set_own_bounds(part, part.hull->low().array() - part.margin,
                   part.hull->high().array() + part.margin);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
