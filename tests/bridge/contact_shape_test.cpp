#include "bullet_bridge/shapes/contact_shape.h"

#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>
#include <gtest/gtest.h>

#include <random>

#include "bullet_bridge/shapes/convex_distance.h"
#include "core/model/errors.h"
#include "tests/bridge/shapes.h"

namespace limber::bullet::test {
namespace {

const Vec3 kHalf(0.5, 1.0, 1.5);

TEST(BoxPenetration, InsideIsTheWayThroughTheNearestSide) {
  const Penetration right = box_penetration(kHalf, {0.4, 0.2, -0.3});
  EXPECT_NEAR(right.depth, 0.1, 1e-15);
  EXPECT_EQ(right.normal, Vec3::UnitX());
  const Penetration bottom = box_penetration(kHalf, {0.1, -0.95, 0.0});
  EXPECT_NEAR(bottom.depth, 0.05, 1e-15);
  EXPECT_EQ(bottom.normal, -Vec3::UnitY());
}

TEST(BoxPenetration, OutsideIsTheDistanceToSideEdgeAndCorner) {
  EXPECT_NEAR(box_penetration(kHalf, {0.7, 0.0, 0.0}).depth, -0.2, 1e-15);
  EXPECT_NEAR(box_penetration(kHalf, {0.8, 1.4, 0.0}).depth, -0.5, 1e-15);  // 3 4 5
  EXPECT_NEAR(box_penetration(kHalf, {1.5, 3.0, 3.5}).depth, -3.0, 1e-14);  // 1 2 2 3
  EXPECT_LT((box_penetration(kHalf, {0.8, 1.4, 0.0}).normal - Vec3(0.6, 0.8, 0.0)).norm(), 1e-14);
}

// depth falls by the way along the normal; a step across it changes nothing in first order.
TEST(BoxPenetration, NormalIsMinusTheGradientOfDepth) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> anywhere(-2.0, 2.0);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 200; ++i) {
    const Vec3 x(anywhere(engine), anywhere(engine), anywhere(engine));
    Vec3 gradient;
    for (int k = 0; k < 3; ++k) {
      const Vec3 h = kStep * Vec3::Unit(k);
      gradient[k] = (box_penetration(kHalf, x + h).depth - box_penetration(kHalf, x - h).depth) /
                    (2.0 * kStep);
    }
    EXPECT_LT((gradient + box_penetration(kHalf, x).normal).norm(), 1e-5) << x.transpose();
  }
}

TEST(ContactParts, OfSphereAndPlaneAreClosedForms) {
  const btSphereShape sphere(btScalar(0.5));
  const Penetration in_sphere = penetration(only_part(sphere), {0.3, 0.0, 0.0});
  EXPECT_NEAR(in_sphere.depth, 0.2, 1e-12);
  EXPECT_EQ(in_sphere.normal, Vec3::UnitX());
  const btStaticPlaneShape plane(btVector3(0, 1, 0), btScalar(0.25));
  const Penetration in_plane = penetration(only_part(plane), {3.0, 0.125, -7.0});
  EXPECT_NEAR(in_plane.depth, 0.125, 1e-12);
  EXPECT_EQ(in_plane.normal, Vec3::UnitY());
}

TEST(ContactParts, OfACompoundAreTurnedAndShifted) {
  btBoxShape box(btVector3(btScalar(0.5), 1, btScalar(1.5)));
  btCompoundShape compound;
  btTransform pose(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI), btVector3(4, 0, 0));
  compound.addChildShape(pose, &box);
  const auto parts = all_parts(compound, 6.0);
  ASSERT_EQ(parts.size(), 1u);
  // The box's own y axis points along -x: its half length of 1 m reaches from 3 to 5 m.
  const Penetration got = penetration(parts[0], {4.9, 0.0, 0.0});
  EXPECT_NEAR(got.depth, 0.1, 1e-6);
  EXPECT_LT((got.normal - Vec3::UnitX()).norm(), 1e-6);
  EXPECT_NEAR(penetration(parts[0], {5.1, 0.0, 0.0}).depth, -0.1, 1e-6);
  EXPECT_NEAR(penetration(parts[0], {4.0, 0.6, 0.0}).depth, -0.1, 1e-6);
}

// Bullet's general query on a hull of a box against the box.
TEST(ContactParts, OfAHullOfABoxAreThoseOfTheBox) {
  btConvexHullShape hull;
  for (int i = 0; i < 8; ++i) {
    hull.addPoint(btVector3(btScalar(i & 1 ? 0.5 : -0.5), btScalar(i & 2 ? 1 : -1),
                            btScalar(i & 4 ? 1.5 : -1.5)),
                  false);
  }
  hull.setMargin(0);
  hull.recalcLocalAabb();
  const ContactPart part = only_part(hull);
  for (const Vec3& x : {Vec3(0.45, 0.1, 0.2), Vec3(0.1, -0.9, 0.3), Vec3(0.6, 0.0, 0.0)}) {
    const Penetration got = penetration(part, x), wanted = box_penetration(kHalf, x);
    EXPECT_NEAR(got.depth, wanted.depth, 5e-4) << x.transpose();
    EXPECT_LT((got.normal - wanted.normal).norm(), 0.02) << x.transpose();
  }
}

// Bullet's signed distance fields are read from files of its own.
TEST(ContactParts, OfADistanceFieldAreRefusedByName) {
  const btSdfCollisionShape shape;
  EXPECT_THROW(all_parts(shape), SimulationError);
}

}  // namespace
}  // namespace limber::bullet::test
