#include "bullet_bridge/shapes/face_penetration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/bridge/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr double kTolerance = 1e-5;  // m

// The deepest of many places all over the face: never deeper than the deepest.
double sampled_depth(const ContactPart& part, const Mat3& corners, int places) {
  double depth = -1e300;
  for (int i = 0; i <= places; ++i) {
    for (int j = 0; i + j <= places; ++j) {
      const Vec3 weights = Vec3(i, j, places - i - j) / places;
      depth = std::max(depth, penetration(part, corners * weights).depth);
    }
  }
  return depth;
}

Mat3 random_face(std::mt19937& engine, double size) {
  std::uniform_real_distribution<double> anywhere(-size, size);
  return Mat3::NullaryExpr([&] { return anywhere(engine); });
}

void expect_deepest(const btCollisionShape& shape) {
  std::mt19937 engine(1);
  const ContactPart part = only_part(shape);
  int inside = 0;
  for (int i = 0; i < 1000; ++i) {
    const Mat3 corners = random_face(engine, 0.7);
    const FacePenetration found = deepest_place(part, corners, kTolerance);
    const double sampled = sampled_depth(part, corners, 40);
    ASSERT_GE(found.weights.minCoeff(), -1e-12);
    ASSERT_NEAR(found.weights.sum(), 1.0, 1e-12);
    ASSERT_GE(found.bound, sampled - 1e-12);
    double of_corners = -1e300;
    for (int k = 0; k < 3; ++k) {
      of_corners = std::max(of_corners, penetration(part, corners.col(k)).depth);
    }
    ASSERT_EQ(found.corners, of_corners);
    if (sampled <= 0.0) continue;
    ++inside;
    ASSERT_GE(found.depth, sampled - 20.0 * kTolerance);  // round parts end at the most cuts
    ASSERT_NEAR(penetration(part, corners * found.weights).depth, found.depth, 1e-12);
  }
  EXPECT_GT(inside, 300);
}

TEST(FacePenetration, FindsTheDeepestPlaceInABox) {
  expect_deepest(btBoxShape(btVector3(btScalar(0.3), btScalar(0.5), btScalar(0.2))));
}

TEST(FacePenetration, FindsTheDeepestPlaceInASphere) {
  expect_deepest(btSphereShape(btScalar(0.3)));
}

// A rod of 2 cm across a face of a metre whose corners are far from it.
TEST(FacePenetration, SeesARodBetweenThePoints) {
  const btBoxShape rod(btVector3(btScalar(0.01), btScalar(0.01), 5));
  Mat3 corners;
  corners.col(0) = Vec3(-0.4, 0.004, -0.3);
  corners.col(1) = Vec3(0.6, 0.004, -0.3);
  corners.col(2) = Vec3(0.1, 0.004, 0.7);
  const ContactPart part = only_part(rod);
  const FacePenetration found = deepest_place(part, corners, kTolerance);
  EXPECT_NEAR(found.depth, 0.006, 1e-6);
  for (int i = 0; i < 3; ++i) EXPECT_LT(penetration(part, corners.col(i)).depth, -0.05);
}

// A corner of a box sticks 1 cm through the middle of a face. It is cut in a regular triangle; by
// the symmetry of the three sides the deepest place is its centre, 1 cm / sqrt(3) from each.
TEST(FacePenetration, SeesACornerThroughTheMiddle) {
  const btBoxShape box(btVector3(1, 1, 1));
  const Vec3 diagonal = Vec3::Ones().normalized();
  const Vec3 across = diagonal.unitOrthogonal();
  const Vec3 middle = Vec3::Ones() - 0.01 * diagonal;
  Mat3 corners;
  for (int i = 0; i < 3; ++i) {
    corners.col(i) =
        middle + 0.5 * (Eigen::AngleAxisd(2.0 * i * EIGEN_PI / 3.0, diagonal) * across);
  }
  const FacePenetration found = deepest_place(only_part(box), corners, kTolerance);
  EXPECT_NEAR(found.depth, 0.01 / std::sqrt(3.0), 1e-6);
  EXPECT_LT((found.weights - Vec3::Constant(1.0 / 3.0)).norm(), 1e-4);
}

TEST(FacePenetration, OfAFaceThatEntersWithACornerIsThatCorner) {
  const btBoxShape box(btVector3(1, 1, 1));
  Mat3 corners;
  corners.col(0) = Vec3(0.0, 1.5, 0.0);
  corners.col(1) = Vec3(0.1, 0.9, 0.0);
  corners.col(2) = Vec3(0.5, 1.5, 0.4);
  const FacePenetration found = deepest_place(only_part(box), corners, kTolerance);
  EXPECT_EQ(found.weights, Vec3::UnitY());
  EXPECT_NEAR(found.depth, 0.1, 1e-6);
}

// A face that is said to be settled may move that far without being deeper between its corners.
TEST(FacePenetration, KeepsItsDeepestPlaceAtACornerWhileItIsSettled) {
  std::mt19937 engine(2);
  const ContactPart part =
      only_part(btBoxShape(btVector3(btScalar(0.3), btScalar(0.5), btScalar(0.2))));
  int settled = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 middle = random_face(engine, 0.6).col(0);
    const Mat3 corners = random_face(engine, 0.1).colwise() + middle;
    const FacePenetration found = deepest_place(part, corners, kTolerance);
    if (found.settled == 0.0) continue;
    ++settled;
    for (int way = 0; way < 20; ++way) {
      Mat3 moved = corners;
      for (int k = 0; k < 3; ++k) {
        moved.col(k) += 0.999 * found.settled * random_face(engine, 1.0).col(k).normalized();
      }
      const FacePenetration then = deepest_place(part, moved, 1e-9);
      ASSERT_EQ(then.depth, then.corners);
    }
  }
  EXPECT_GT(settled, 1000);
}

}  // namespace
}  // namespace limber::bullet::test
