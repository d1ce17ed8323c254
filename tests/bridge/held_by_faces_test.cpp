#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// What is thinner than a lattice's cells lies on its faces: no point of it is there to bear it.

namespace limber::bullet::test {
namespace {

constexpr double kRadius = 0.01;  // m, of the rod: a tenth of the spacing
constexpr double kClear = 0.015;  // m, from its middle: a point there is outside of it
constexpr double kTop = 0.3;      // m
constexpr Block kBlock = {.modulus = 1e6, .damping_ratio = 0.2, .internal_damping = 5.0};

enum class Rod { kCapsule, kBox };

// Along z.
btRigidBody& add_rod(World& world, Rod kind, double mass, const Vec3& centre) {
  const auto radius = btScalar(kRadius);
  if (kind == Rod::kBox) return world.add_box({kRadius, kRadius, 0.25}, mass, centre);
  return world.add(std::make_unique<btCapsuleShapeZ>(radius, btScalar(0.5)), mass, centre);
}

// m, from the middle of the rod to the nearest point of the lattice, across the rod.
double nearest_point(const PhysicalModel& model, const btRigidBody& rod) {
  const Vec3 centre = from_bullet(rod.getWorldTransform().getOrigin());
  double nearest = 1e300;
  for (const Vec3& x : model.geometry.points) {
    nearest = std::min(nearest, std::hypot(x.x() - centre.x(), x.y() - centre.y()));
  }
  return nearest;
}

// Lowest of the points on top, m: faces between them are no lower.
double lowest_on_top(const PhysicalModel& now, const PhysicalModel& at_first) {
  double low = 1e300;
  for (PointId p : ids_of(now.points)) {
    if (at_first.geometry.points[p].y() < kTop - 1e-9) continue;
    low = std::min(low, now.geometry.points[p].y());
  }
  return low;
}

struct Lying {
  double deepest = -1e300;  // m, of the rod's lower side in the top
  double nearest = 1e300;   // m, of a point to its middle
  double at_end = 0.0;      // m, as deepest
};

// A rod over the middle of the block's cells, `drop` m above it.
Lying lay(Rod kind, double mass, double drop) {
  World world;
  world.add_ground();
  btRigidBody& rod = add_rod(world, kind, mass, {0.0, kTop + kRadius + drop, 0.0});
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  const PhysicalModel block = make_block(kBlock, {0.0, 0.5 * kTop, 0.0});
  simulation.add(block);
  Lying lying;
  for (int tick = 0; tick < 40; ++tick) {
    world.step(kTick);
    const PhysicalModel now = simulation.model(0);
    const double lower_side = rod.getWorldTransform().getOrigin().y() - kRadius;
    lying.at_end = lowest_on_top(now, block) - lower_side;
    lying.deepest = std::max(lying.deepest, lying.at_end);
    lying.nearest = std::min(lying.nearest, nearest_point(now, rod));
  }
  EXPECT_FALSE(simulation.failure());
  return lying;
}

class HeldByFaces : public testing::TestWithParam<Rod> {};

TEST_P(HeldByFaces, ARodThatIsLaidAcross) {
  for (double mass : {0.1, 1.0, 3.0}) {
    const Lying lying = lay(GetParam(), mass, 0.001);
    EXPECT_LT(lying.deepest, kRadius) << mass << " kg: its middle is under the top";
    EXPECT_GT(lying.nearest, kClear) << mass << " kg: points hold it";
  }
}

// Half a spacing deep at the most, as in tests/contact_scenes.
void expect_held(const Lying& lying) {
  EXPECT_LT(lying.deepest, 0.5 * kBlock.spacing);
  EXPECT_LT(lying.at_end, kRadius) << "its middle is under the top";
  EXPECT_GT(lying.nearest, kClear) << "points hold it";
}

TEST_P(HeldByFaces, ARodThatFallsTenCentimetres) {
  for (double mass : {0.1, 1.0}) expect_held(lay(GetParam(), mass, 0.1));
}

TEST_P(HeldByFaces, ARodThatFallsThirtyCentimetres) { expect_held(lay(GetParam(), 1.0, 0.3)); }

INSTANTIATE_TEST_SUITE_P(Rods, HeldByFaces, testing::Values(Rod::kCapsule, Rod::kBox),
                         [](const auto& rod) {
                           return rod.param == Rod::kCapsule ? "Capsule" : "Box";
                         });

}  // namespace
}  // namespace limber::bullet::test
