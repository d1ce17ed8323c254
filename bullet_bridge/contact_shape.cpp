#include "bullet_bridge/contact_shape.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "bullet_bridge/conversions.h"
#include "core/model/errors.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

ContactPart part_of(const btCollisionShape& shape, const Vec3& position, const Mat3& rotation) {
  ContactPart part;
  part.position = position;
  part.rotation = rotation;
  part.rotated = !rotation.isIdentity(0.0);
  switch (shape.getShapeType()) {
    case BOX_SHAPE_PROXYTYPE:
      part.kind = ContactPart::Kind::kBox;
      part.half_extents =
          from_bullet(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin());
      return part;
    case SPHERE_SHAPE_PROXYTYPE:
      part.kind = ContactPart::Kind::kSphere;
      part.radius = static_cast<const btSphereShape&>(shape).getRadius();
      return part;
    case STATIC_PLANE_PROXYTYPE: {
      const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
      part.kind = ContactPart::Kind::kPlane;
      part.plane_normal = from_bullet(plane.getPlaneNormal());
      part.plane_offset = plane.getPlaneConstant();
      return part;
    }
    default:
      break;
  }
  if (!shape.isConvex()) {
    throw SimulationError({std::string("collision shape ") + shape.getName(),
                           "a flexible body has come near a concave shape",
                           "build it from boxes, spheres, planes or convex hulls"});
  }
  part.kind = ContactPart::Kind::kConvex;
  part.convex = static_cast<const btConvexShape*>(&shape);
  return part;
}

void collect(const btCollisionShape& shape, const btTransform& pose,
             std::vector<ContactPart>& parts) {
  if (!shape.isCompound()) {
    parts.push_back(part_of(shape, from_bullet(pose.getOrigin()),
                            from_bullet(pose.getRotation()).toRotationMatrix()));
    return;
  }
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    collect(*compound.getChildShape(i), pose * compound.getChildTransform(i), parts);
  }
}

// GJK between the shape and a tiny sphere; EPA where they overlap.
Penetration convex_penetration(const btConvexShape& shape, const Vec3& point) {
  constexpr double kProbe = 1e-4;  // m, radius of the sphere that stands for the point
  const btSphereShape probe(kProbe);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth_solver;
  btGjkPairDetector detector(&probe, &shape, &simplex, &depth_solver);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA.setIdentity();
  input.m_transformA.setOrigin(to_bullet(point));
  input.m_transformB.setIdentity();
  btPointCollector result;
  detector.getClosestPoints(input, result, nullptr);
  if (!result.m_hasResult) return {-1.0, Vec3::UnitY()};
  return {-(result.m_distance + kProbe), from_bullet(result.m_normalOnBInWorld)};
}

Penetration in_part_frame(const ContactPart& part, const Vec3& point) {
  switch (part.kind) {
    case ContactPart::Kind::kBox:
      return box_penetration(part.half_extents, point);
    case ContactPart::Kind::kSphere: {
      const double distance = point.norm();
      const Vec3 normal = distance > 0.0 ? Vec3(point / distance) : Vec3(Vec3::UnitY());
      return {part.radius - distance, normal};
    }
    case ContactPart::Kind::kPlane:
      return {part.plane_offset - part.plane_normal.dot(point), part.plane_normal};
    case ContactPart::Kind::kConvex:
      break;
  }
  return convex_penetration(*part.convex, point);
}

}  // namespace

std::vector<ContactPart> contact_parts(const btCollisionShape& shape) {
  std::vector<ContactPart> parts;
  collect(shape, btTransform::getIdentity(), parts);
  return parts;
}

ContactPart placed(ContactPart part, const Vec3& position, const Mat3& rotation) {
  part.position = position + rotation * part.position;
  part.rotation = rotation * part.rotation;
  part.rotated = !part.rotation.isIdentity(0.0);
  return part;
}

Penetration penetration(const ContactPart& part, const Vec3& point) {
  Penetration result = in_part_frame(part, part.to_part_frame(point));
  if (part.rotated) result.normal = part.rotation * result.normal;
  return result;
}

Penetration box_penetration(const Vec3& half_extents, const Vec3& point) {
  const Vec3 outside = point.cwiseAbs() - half_extents;
  int axis = 0;
  const double nearest = outside.maxCoeff(&axis);
  Vec3 normal = Vec3::Zero();
  if (nearest <= 0.0) {
    normal[axis] = point[axis] < 0.0 ? -1.0 : 1.0;
    return {-nearest, normal};
  }
  const Vec3 gap = outside.cwiseMax(0.0);
  const double distance = gap.norm();
  for (int i = 0; i < 3; ++i) normal[i] = (point[i] < 0.0 ? -gap[i] : gap[i]) / distance;
  return {-distance, normal};
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
