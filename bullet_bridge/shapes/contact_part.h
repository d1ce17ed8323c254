#pragma once

#include <cstdint>
#include <memory>

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

class btConcaveShape;
class btConvexShape;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

class ConvexPlanes;
class TrianglePatch;

// How deep a point lies in a shape.
struct Penetration {
  double depth = 0.0;  // m, negative outside
  Vec3 normal;         // unit, out of the shape
};

// One convex part of a collision shape, or its triangles, asked for single points.
//
// The surface is where two of Bullet's own bodies rest against each other: box and sphere with
// their margin inside; cylinder with its margin inside, its rims rounded by it; cone, hull and
// triangles with their margin around them. A box has sharp edges here, as against other boxes in
// Bullet, which rounds them by the margin against everything else. Shapes of Bullet without a
// closed form of their own are asked through Bullet's general query (kConvex, 2 us and more a
// point).
struct ContactPart {
  enum class Kind {
    kBox,
    kSphere,
    kPlane,
    kCapsule,    // axis: own y
    kCylinder,   // axis: own y
    kCone,       // axis: own y, tip upwards
    kHull,       // planes of a polyhedron
    kTriangles,  // of a mesh or height field, two-sided, without inside
    kConvex      // anything else
  };
  Kind kind = Kind::kConvex;
  std::int64_t id = 0;               // of the part among all of the shape, the same in every tick
  bool for_faces = false;            // points meet the triangles that it is cut out of
  Vec3 facing = Vec3::Zero();        // then: no way in against this, in the part's frame
  Vec3 half_extents = Vec3::Zero();  // box, m
  double radius = 0.0;               // sphere, capsule, cylinder and cone without margin, m
  double half_height = 0.0;          // capsule without caps, cylinder and cone without margin, m
  double margin = 0.0;               // around cylinder, cone, hull and triangles, m
  Vec3 plane_normal = Vec3::Zero();  // plane: n . x = offset
  double plane_offset = 0.0;         // m
  const btConvexShape* convex = nullptr;
  const btConcaveShape* concave = nullptr;
  std::shared_ptr<const ConvexPlanes> hull;
  std::shared_ptr<const TrianglePatch> triangles;

  Vec3 position = Vec3::Zero();  // of the part in the frame of the whole shape, m
  Mat3 rotation = Mat3::Identity();
  bool rotated = false;  // spares most parts a matrix product

  // Bounds of the surface, infinite for planes, m.
  Vec3 own_low = Vec3::Zero(), own_high = Vec3::Zero();  // in the part's frame
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();          // in the frame of the whole shape
  double tolerance = 0.0;  // what a distance to the surface may be wrong by, m

  Vec3 to_part_frame(const Vec3& point) const {
    if (!rotated) return point - position;
    return rotation.transpose() * (point - position);
  }
  Vec3 direction_to_part_frame(const Vec3& v) const {
    return rotated ? Vec3(rotation.transpose() * v) : v;
  }
  Vec3 direction_from_part_frame(const Vec3& v) const { return rotated ? Vec3(rotation * v) : v; }
};

// The part as it is when the whole shape is placed at a pose.
ContactPart placed(ContactPart part, const Vec3& position, const Mat3& rotation);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
