#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/sheets.h"
#include "tests/bridge/world.h"

// Balls against a sheet with cells of 10 cm, of points and of faces, from both its sides.

namespace limber::bullet::test {
namespace {

constexpr int kCells = 8;
constexpr double kSide = 0.8;    // m
constexpr double kSpeed = 10.0;  // m/s

// Pinned along its border.
PhysicalModel pinned_sheet() {
  PhysicalModel model = level_sheet(kCells, kSide);
  for (PointId p : ids_of(model.points)) {
    const double out = model.geometry.points[p].cwiseAbs().maxCoeff();
    model.points[p].pinned = out > 0.5 * kSide - 1e-9;
  }
  return model;
}

struct Throw {
  std::string name;
  double radius;  // m
  double side;    // 1: onto its front, from above; -1: onto its back
};

// For gtest's messages.
void PrintTo(const Throw& thrown, std::ostream* out) { *out << thrown.name; }

class ThrownAtSheet : public testing::TestWithParam<Throw> {};

// Half a spacing deep at the most, as in tests/contact_scenes, and back again.
TEST_P(ThrownAtSheet, DoesNotPassWhatIsWhole) {
  const auto& [name, radius, side] = GetParam();
  World world(0.0);
  const Vec3 start(0.03, side * (radius + 0.05), 0.02);
  btRigidBody& ball = world.add(std::make_unique<btSphereShape>(btScalar(radius)), 1.0, start);
  ball.setLinearVelocity(to_bullet(Vec3(0.0, -side * kSpeed, 0.0)));
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(pinned_sheet());
  double lowest = 0.0, deepest = 0.0;
  for (int tick = 0; tick < 15; ++tick) {
    world.step(kTick);
    ASSERT_FALSE(simulation.failure());
    const Vec3 centre = from_bullet(ball.getWorldTransform().getOrigin());
    const double sheet = height_at(simulation.model(0), centre.x(), centre.z());
    lowest = std::min(lowest, side * sheet);
    deepest = std::max(deepest, radius - side * (centre.y() - sheet));
  }
  EXPECT_EQ(simulation.counters().broken_edges, 0u);
  EXPECT_LT(lowest, -0.03) << "nothing was hit";
  EXPECT_LT(deepest, 0.5 * kSide / kCells);
  EXPECT_GT(side * ball.getLinearVelocity().y(), 0.0) << "is not on its way back";
}

INSTANTIATE_TEST_SUITE_P(Balls, ThrownAtSheet,
                         testing::Values(Throw{"LargeOnTheFront", 0.1, 1.0},
                                         Throw{"LargeOnTheBack", 0.1, -1.0},
                                         Throw{"SmallOnTheFront", 0.03, 1.0},
                                         Throw{"SmallOnTheBack", 0.03, -1.0}),
                         [](const auto& thrown) { return thrown.param.name; });

}  // namespace
}  // namespace limber::bullet::test
