#include "tests/contact_scenes/shapes.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>

#include <algorithm>

#include "bullet_bridge/conversions.h"

namespace limber::bullet::test {
namespace {

constexpr btScalar kMargin = btScalar(0.001);  // m

btScalar scalar(double value) { return static_cast<btScalar>(value); }

struct Mesh {
  std::vector<btScalar> coordinates;
  std::vector<int> corners;
  btTriangleIndexVertexArray array;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
};

void add_square(Mesh& mesh, int corner, int row) {
  for (int c : {corner, corner + row, corner + 1, corner + 1, corner + row, corner + row + 1}) {
    mesh.corners.push_back(c);
  }
}

std::shared_ptr<Mesh> relief_mesh(const Relief& height, double side, int cells, double scale) {
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      const double x = side * (double(k) / cells - 0.5), z = side * (double(i) / cells - 0.5);
      for (double c : {x, height(x, z), z}) mesh->coordinates.push_back(scalar(c * scale));
      if (i < cells && k < cells) add_square(*mesh, i * (cells + 1) + k, cells + 1);
    }
  }
  btIndexedMesh part;
  part.m_numTriangles = int(mesh->corners.size() / 3);
  part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(mesh->corners.data());
  part.m_triangleIndexStride = 3 * sizeof(int);
  part.m_numVertices = int(mesh->coordinates.size() / 3);
  part.m_vertexBase = reinterpret_cast<const unsigned char*>(mesh->coordinates.data());
  part.m_vertexStride = 3 * sizeof(btScalar);
  mesh->array.addIndexedMesh(part);
  mesh->shape = std::make_unique<btBvhTriangleMeshShape>(&mesh->array, true);
  mesh->shape->setMargin(kMargin);
  return mesh;
}

}  // namespace

Shape box(const Vec3& size) { return std::make_shared<btBoxShape>(to_bullet(Vec3(0.5 * size))); }

Shape sphere(double radius) { return std::make_shared<btSphereShape>(scalar(radius)); }

Shape capsule(double radius, double length) {
  return std::make_shared<btCapsuleShape>(scalar(radius), scalar(length - 2.0 * radius));
}

Shape cylinder(double radius, double height) {
  auto shape = std::make_shared<btCylinderShape>(to_bullet(Vec3(radius, 0.5 * height, radius)));
  shape->setMargin(kMargin);
  return shape;
}

Shape cone(double radius, double height) {
  auto shape = std::make_shared<btConeShape>(scalar(radius), scalar(height));
  shape->setMargin(kMargin);
  return shape;
}

Shape hull(const std::vector<Vec3>& points) {
  auto shape = std::make_shared<btConvexHullShape>();
  shape->setMargin(kMargin);
  for (const Vec3& p : points) shape->addPoint(to_bullet(p), false);
  shape->recalcLocalAabb();
  return shape;
}

Shape compound(const std::vector<Part>& parts) {
  struct Owner {
    std::vector<Part> parts;
    btCompoundShape shape;
  };
  auto owner = std::make_shared<Owner>();
  owner->parts = parts;
  for (const Part& part : parts) {
    const btTransform pose(btQuaternion::getIdentity(), to_bullet(part.position));
    owner->shape.addChildShape(pose, part.shape.get());
  }
  return {owner, &owner->shape};
}

Shape mesh_floor(const Relief& height, double side, int cells) {
  auto mesh = relief_mesh(height, side, cells, 1.0);
  return {mesh, mesh->shape.get()};
}

Shape scaled_mesh_floor(const Relief& height, double side, int cells) {
  struct Owner {
    std::shared_ptr<Mesh> mesh;
    btScaledBvhTriangleMeshShape shape;
    explicit Owner(std::shared_ptr<Mesh> half)
        : mesh(std::move(half)), shape(mesh->shape.get(), btVector3(2, 2, 2)) {}
  };
  auto owner = std::make_shared<Owner>(relief_mesh(height, side, cells, 0.5));
  owner->shape.setMargin(kMargin);
  return {owner, &owner->shape};
}

// Bullet centres a heightfield between the least and the greatest height: both are +-side here.
Shape heightfield(const Relief& height, double side, int cells) {
  struct Owner {
    std::vector<btScalar> heights;
    std::unique_ptr<btHeightfieldTerrainShape> shape;
  };
  auto owner = std::make_shared<Owner>();
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      owner->heights.push_back(scalar(height(side * (double(k) / cells - 0.5),  //
                                             side * (double(i) / cells - 0.5))));
    }
  }
  owner->shape = std::make_unique<btHeightfieldTerrainShape>(
      cells + 1, cells + 1, owner->heights.data(), scalar(-side), scalar(side), 1, false);
  const btScalar step = scalar(side / cells);
  owner->shape->setLocalScaling({step, 1, step});
  owner->shape->setMargin(kMargin);
  return {owner, owner->shape.get()};
}

}  // namespace limber::bullet::test
