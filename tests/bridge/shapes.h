#pragma once

#include <BulletCollision/CollisionShapes/btBox2dShape.h>
#include <BulletCollision/CollisionShapes/btConvex2dShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/shapes/contact_shape.h"
#include "bullet_bridge/shapes/point_track.h"
#include "bullet_bridge/shapes/shape_cache.h"
#include "bullet_bridge/shapes/triangle_patch.h"
#include "tests/bridge/random.h"

namespace limber::bullet::test {

inline btVector3 bt(double x, double y, double z) { return to_bullet(Vec3(x, y, z)); }

// All parts within a box of 2 * reach.
inline std::vector<ContactPart> all_parts(const btCollisionShape& shape, double reach = 3.0) {
  ShapeCache cache;
  return contact_parts(shape, Vec3::Constant(-reach), Vec3::Constant(reach), cache);
}

inline ContactPart only_part(const btCollisionShape& shape, double reach = 3.0) {
  return all_parts(shape, reach).at(0);
}

// Points evenly about a sphere (golden spiral).
inline std::vector<Vec3> sphere_points(int count, double radius) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - y * y), turn = 2.39996 * i;
    points.emplace_back(radius * Vec3(r * std::cos(turn), y, r * std::sin(turn)));
  }
  return points;
}

inline std::unique_ptr<btConvexHullShape> hull_of(const std::vector<Vec3>& points) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& p : points) hull->addPoint(to_bullet(p), false);
  hull->recalcLocalAabb();
  return hull;
}

inline std::vector<Vec3> box_corners(const Vec3& half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(),
                         (i & 4 ? 1 : -1) * half.z());
  }
  return corners;
}

// A mesh of Bullet's that owns its triangles.
class Mesh {
 public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    triangles_.addTriangle(to_bullet(a), to_bullet(b), to_bullet(c));
    corners.push_back({a, b, c});
  }
  const btBvhTriangleMeshShape& shape() {
    if (!shape_) shape_ = std::make_unique<btBvhTriangleMeshShape>(&triangles_, true);
    return *shape_;
  }
  btTriangleMesh& triangles() { return triangles_; }

  std::vector<Triangle> corners;

 private:
  btTriangleMesh triangles_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

// A net of cells x cells squares of the size, halved at random, over height(x, z), facing up.
inline void add_net(Mesh& mesh, int cells, double size,
                    const std::function<double(double, double)>& height) {
  std::mt19937 engine(3);
  const auto at = [&](int i, int k) -> Vec3 {
    const double x = (i - 0.5 * cells) * size, z = (k - 0.5 * cells) * size;
    return from_bullet(bt(x, height(x, z), z));
  };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      const Vec3 a = at(i, k), b = at(i + 1, k), c = at(i + 1, k + 1), d = at(i, k + 1);
      if (engine() & 1u) {
        mesh.add(a, c, b);
        mesh.add(a, d, c);
      } else {
        mesh.add(a, d, b);
        mesh.add(b, d, c);
      }
    }
  }
}

inline void add_box(Mesh& mesh, const Vec3& half) {
  const std::vector<Vec3> c = box_corners(half);
  constexpr int kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& s : kSides) {
    mesh.add(c[s[0]], c[s[1]], c[s[2]]);
    mesh.add(c[s[0]], c[s[2]], c[s[3]]);
  }
}

}  // namespace limber::bullet::test
