#include "core/modeller/winding_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/lattices.h"
#include "tests/support/meshes.h"

namespace limber {
namespace {

constexpr double kPi = std::numbers::pi;

// One octant: an eighth of the whole sphere of directions.
TEST(SolidAngle, OfAnOctant) {
  EXPECT_NEAR(solid_angle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, Vec3::Zero()), kPi / 2, 1e-15);
  EXPECT_NEAR(solid_angle({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, Vec3::Zero()), -kPi / 2, 1e-15);
}

TEST(WindingNumber, IsOneInsideAndZeroOutside) {
  for (const TriangleMesh& mesh :
       {test::box_mesh({-1, -1, -1}, {1, 1, 1}), test::icosphere(1, 3)}) {
    EXPECT_NEAR(winding_number(mesh, {0.1, 0.2, -0.3}), 1.0, 1e-12);
    EXPECT_NEAR(winding_number(mesh, {0.1, 1.2, -0.3}), 0.0, 1e-12);
    EXPECT_NEAR(winding_number(mesh, {20, 30, 50}), 0.0, 1e-12);
  }
}

TEST(WindingNumber, CountsOverlapsAndTurnsWithTheMesh) {
  const TriangleMesh box = test::box_mesh({0, 0, 0}, {2, 2, 2});
  const TriangleMesh two = test::together(box, test::box_mesh({1, 1, 1}, {3, 3, 3}));
  EXPECT_NEAR(winding_number(two, {1.5, 1.5, 1.5}), 2.0, 1e-12);
  EXPECT_NEAR(winding_number(test::inside_out(box), {1, 1, 1}), -1.0, 1e-12);
}

// A hemisphere without its disc, seen from the axis at height y: the rim's cone leaves
// w = (1 + y / sqrt(y^2 + R^2)) / 2 inside, from the solid angle 2 pi (1 - cos) of a disc. Exactly
// 1/2 in the middle of the missing disc.
TEST(WindingNumber, OfAnOpenHemisphereIsItsClosedForm) {
  const TriangleMesh open = test::hemisphere(1.0, 64, 0.0);
  EXPECT_NEAR(winding_number(open, {0, 0, 0}), 0.5, 1e-12);
  for (double y : {0.2, 0.5, 0.8})
    EXPECT_NEAR(winding_number(open, {0, y, 0}), 0.5 * (1 + y / std::hypot(y, 1.0)), 1e-4);
  EXPECT_NEAR(winding_number(open, {0, -0.5, 0}), 0.5 * (1 - 0.5 / std::hypot(0.5, 1.0)), 1e-4);
}

struct Difference {
  double worst = 0.0;
  double mean = 0.0;
};

Difference difference(const TriangleMesh& mesh) {
  constexpr int kPlaces = 1000;
  const FastWindingNumber fast(mesh);
  std::mt19937 random(5);
  Difference d;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec3 q = test::random_vector(random, 1.5);
    const double off = std::abs(fast.at(q) - winding_number(mesh, q));
    d.worst = std::max(d.worst, off);
    d.mean += off / kPlaces;
  }
  return d;
}

TEST(FastWindingNumber, IsNearTheSum) {
  for (const TriangleMesh& mesh :
       {test::icosphere(1, 4), test::torus_mesh(1, 0.3, 80, 40), test::hemisphere(1, 24, 0.0),
        test::with_flipped(test::icosphere(1, 3), 5), test::box_mesh({-1, -1, -1}, {1, 1, 1})}) {
    const Difference d = difference(mesh);
    EXPECT_LT(d.worst, 0.04) << mesh.name;
    EXPECT_LT(d.mean, 0.003) << mesh.name;
  }
}

TEST(FastWindingNumber, OfNothingIsZero) {
  EXPECT_EQ(FastWindingNumber(TriangleMesh{}).at({1, 2, 3}), 0.0);
}

}  // namespace
}  // namespace limber
