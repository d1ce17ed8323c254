#include "bullet_bridge/stage_body.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/shapes/convex_planes.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

using ShapePointer = std::unique_ptr<btCollisionShape>;

// Hulls are laid in by this share of their size, and stand out by as much (Bullet's margin).
constexpr double kHullMargin = 0.01;
constexpr double kRoundMargin = 0.01;  // cones likewise, of their smaller side

btScalar scalar(double value) { return static_cast<btScalar>(value); }

ShapePointer hull_of(const HullShape& hull) {
  Vec3 low = hull.points.front(), high = low, middle = Vec3::Zero();
  for (const Vec3& p : hull.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    middle += p / static_cast<double>(hull.points.size());
  }
  const double margin = kHullMargin * (high - low).minCoeff();
  auto shape = std::make_unique<btConvexHullShape>();
  shape->setMargin(scalar(margin));
  for (const Vec3& p : hull.points) {
    const Vec3 outwards = p - middle;
    const double reach = std::max(outwards.norm(), margin);
    shape->addPoint(to_bullet(Vec3(p - margin / reach * outwards)), false);
  }
  shape->recalcLocalAabb();
  return shape;
}

TriangleList triangles_of_hull(const HullShape& hull) {
  TriangleList list{hull.points, {}};
  for (const HullFace& face : hull_faces(hull.points)) {
    for (std::size_t i = 1; i + 1 < face.corners.size(); ++i) {
      list.triangles.push_back({face.corners[0], face.corners[i], face.corners[i + 1]});
    }
  }
  return list;
}

TriangleList triangles_of_terrain(const TerrainShape& terrain) {
  TriangleList list;
  const Vec3 corner(-0.5 * terrain.spacing * (terrain.columns - 1), 0.0,
                    -0.5 * terrain.spacing * (terrain.rows - 1));
  for (int r = 0; r < terrain.rows; ++r) {
    for (int c = 0; c < terrain.columns; ++c) {
      const double height = terrain.heights[static_cast<std::size_t>(r * terrain.columns + c)];
      list.positions.push_back(corner + Vec3(c * terrain.spacing, height, r * terrain.spacing));
      if (r == 0 || c == 0) continue;
      const int here = r * terrain.columns + c, above = here - terrain.columns;
      list.triangles.push_back({above - 1, here - 1, here});
      list.triangles.push_back({above - 1, here, above});
    }
  }
  return list;
}

}  // namespace

struct OwnedShape::Data {
  btTriangleMesh mesh;

  ShapePointer of_triangles(const TriangleList& list) {
    for (const auto& t : list.triangles) {
      mesh.addTriangle(to_bullet(list.positions[static_cast<std::size_t>(t[0])]),
                       to_bullet(list.positions[static_cast<std::size_t>(t[1])]),
                       to_bullet(list.positions[static_cast<std::size_t>(t[2])]));
    }
    return std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
  }

  ShapePointer operator()(const BoxShape& box) {
    return std::make_unique<btBoxShape>(to_bullet(box.half_extents));
  }
  ShapePointer operator()(const SphereShape& sphere) {
    return std::make_unique<btSphereShape>(scalar(sphere.radius));
  }
  ShapePointer operator()(const CapsuleShape& capsule) {
    return std::make_unique<btCapsuleShape>(scalar(capsule.radius), scalar(capsule.height));
  }
  ShapePointer operator()(const CylinderShape& cylinder) {
    const btVector3 half(scalar(cylinder.radius), scalar(0.5 * cylinder.height),
                         scalar(cylinder.radius));
    return std::make_unique<btCylinderShape>(half);
  }
  // Bullet lays its margin around a cone: it stands on that.
  ShapePointer operator()(const ConeShape& cone) {
    const double margin = kRoundMargin * std::min(cone.radius, cone.height);
    auto shape = std::make_unique<btConeShape>(scalar(cone.radius - margin),
                                               scalar(cone.height - 2.0 * margin));
    shape->setMargin(scalar(margin));
    return shape;
  }
  ShapePointer operator()(const HullShape& hull) { return hull_of(hull); }
  ShapePointer operator()(const MeshShape& shape) {
    return of_triangles({shape.positions, shape.triangles});
  }
  // As a mesh: Bullet's own height field keeps a reference to heights that it moves to their
  // middle.
  ShapePointer operator()(const TerrainShape& terrain) {
    return of_triangles(triangles_of_terrain(terrain));
  }
};

OwnedShape::OwnedShape(const StageShape& shape)
    : data_(std::make_unique<Data>()), shape_(std::visit(*data_, shape)) {}
OwnedShape::~OwnedShape() = default;
OwnedShape::OwnedShape(OwnedShape&&) noexcept = default;

TriangleList triangles_of(const StageShape& shape) {
  if (const auto* hull = std::get_if<HullShape>(&shape)) return triangles_of_hull(*hull);
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) return {mesh->positions, mesh->triangles};
  if (const auto* terrain = std::get_if<TerrainShape>(&shape))
    return triangles_of_terrain(*terrain);
  return {};
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
