#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/bridge/models.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/penetration.h"
#include "tests/contact_scenes/rigid_bodies.h"
#include "tests/contact_scenes/shapes.h"
#include "tests/contact_scenes/true_shape.h"

// The scenes' own measures against what is known by hand.

namespace limber::bullet::test {
namespace {

constexpr double kRounding = 1e-6;  // m, of single precision

TEST(TrueShape, IsAsDeepAsByHand) {
  EXPECT_NEAR(depth_inside(*box({0.2, 0.4, 0.6}), {0.07, 0.0, 0.0}), 0.03, kRounding);
  EXPECT_NEAR(depth_inside(*sphere(0.5), {0.3, 0.0, 0.0}), 0.2, kRounding);
  EXPECT_NEAR(depth_inside(*capsule(0.1, 1.0), {0.0, 0.45, 0.0}), 0.05, kRounding);
  EXPECT_NEAR(depth_inside(*cylinder(0.2, 1.0), {0.15, 0.48, 0.0}), 0.02, kRounding);
  // 3-4-5: the side of a cone of radius 3 and height 4 is 12/5 from the middle of its base.
  EXPECT_NEAR(depth_inside(*cone(3.0, 4.0), {0.0, -2.0 + 1e-3, 0.0}), 1e-3, kRounding);
  EXPECT_NEAR(depth_inside(*cone(3.0, 4.0), {0.0, 0.0, 0.0}), 6.0 / 5.0, kRounding);
}

TEST(TrueShape, OfAHullIsThatOfTheSameBox) {
  std::vector<Vec3> corners;
  for (int code = 0; code < 8; ++code) {
    corners.emplace_back(code & 1 ? 0.1 : -0.1, code & 2 ? 0.2 : -0.2, code & 4 ? 0.3 : -0.3);
  }
  const Shape as_hull = hull(corners), as_box = box({0.2, 0.4, 0.6});
  for (const Vec3& p : {Vec3(0.05, 0.1, -0.2), Vec3(0.0, 0.19, 0.0), Vec3(-0.12, 0.0, 0.0)}) {
    EXPECT_NEAR(depth_inside(*as_hull, p), depth_inside(*as_box, p), kRounding);
  }
}

TEST(TrueShape, OfReliefsIsTheDistanceFromTheirSlope) {
  const auto slope = [](double x, double) { return 0.75 * x; };  // 3-4-5
  const Vec3 below(0.213, 0.75 * 0.213 - 0.1, 0.127);
  for (const Shape& floor :
       {mesh_floor(slope, 2.0, 8), scaled_mesh_floor(slope, 2.0, 8), heightfield(slope, 2.0, 8)}) {
    EXPECT_NEAR(depth_inside(*floor, below), 0.1 * 0.8, 1e-5) << floor->getName();
    EXPECT_LT(depth_inside(*floor, below + 0.2 * Vec3::UnitY()), 0.0) << floor->getName();
  }
}

// Of one body of this shape there, m.
double penetration_of(const PhysicalModel& model, const Shape& shape, const Vec3& position) {
  btRigidBody body(1, nullptr, shape.get());
  btTransform pose = btTransform::getIdentity();
  pose.setOrigin({btScalar(position.x()), btScalar(position.y()), btScalar(position.z())});
  body.setWorldTransform(pose);
  return deepest_penetration({0.0, {model}, {&body}});
}

TEST(Penetration, SeesWhatOverlaps) {
  const PhysicalModel block = make_block(toy_block(0.5, 5, 1e5), Vec3::Zero());
  EXPECT_EQ(penetration_of(block, box(Vec3::Ones()), {0.0, 0.76, 0.0}), 0.0);
  EXPECT_NEAR(penetration_of(block, box(Vec3::Ones()), {0.0, 0.72, 0.0}), 0.03, 1e-5);
  EXPECT_NEAR(penetration_of(block, box({3.0, 1.0, 3.0}), {0.0, 0.72, 0.0}), 0.03, 1e-5);
}

// None of the block's points and faces are in the ball.
TEST(Penetration, SeesABallThatIsAllInside) {
  const PhysicalModel block = make_block(toy_block(0.5, 5, 1e5), Vec3::Zero());
  EXPECT_NEAR(penetration_of(block, sphere(0.01), {0.05, 0.1, 0.05}), 0.16, 1e-5);
}

TEST(Penetration, SeesARodBetweenTheSheetsPoints) {
  const PhysicalModel sheet = make_sheet({.side = 1.1, .cells = 11}, Vec3::Zero());
  EXPECT_GT(penetration_of(sheet, capsule(0.01, 0.2), {0.01, 0.0, 0.0}), 0.0);
  EXPECT_EQ(penetration_of(sheet, capsule(0.01, 0.2), {0.01, 0.11, 0.0}), 0.0);
  EXPECT_EQ(penetration_of(sheet, sphere(0.1), {0.0, -0.11, 0.0}), 0.0) << "a sheet has no inside";
}

TEST(Penetration, SeesOneLatticeInAnother) {
  const PhysicalModel block = make_block(toy_block(0.5, 5, 1e5), Vec3::Zero());
  const SceneState apart{0.0, {block, make_needle({0.01, 0.26, 0.0})}, {}};
  const SceneState inside{0.0, {block, make_needle({0.01, 0.2, 0.0})}, {}};
  EXPECT_EQ(deepest_penetration(apart), 0.0);
  EXPECT_NEAR(deepest_penetration(inside), 0.05, 1e-5);
}

}  // namespace
}  // namespace limber::bullet::test
