#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/shapes.h"
#include "tests/bridge/world.h"

// A lattice that is dropped on a floor of any kind comes to rest on it, as high as on a box.

namespace limber::bullet::test {
namespace {

enum class Floor { kBox, kPlate, kMesh, kHeightfield };

constexpr int kFloorCells = 8;
constexpr double kFloorCell = 0.23;  // m, none of the block's spacings
constexpr double kPlate = 0.002;     // m thick: thinner than the block sinks in
constexpr Block kBlock = {.modulus = 1e6, .damping_ratio = 0.2, .internal_damping = 5.0};

double thickness(Floor kind) {  // m
  if (kind == Floor::kBox) return 1.0;
  return kind == Floor::kPlate ? kPlate : 0.0;
}

// A floor with its top at y = 0 and what it refers to.
struct FlatFloor {
  Mesh mesh;
  std::vector<btScalar> heights;

  std::unique_ptr<btCollisionShape> shape(Floor kind) {
    if (kind == Floor::kBox) return std::make_unique<btBoxShape>(bt(2.0, 0.5, 2.0));
    if (kind == Floor::kPlate) return std::make_unique<btBoxShape>(bt(2.0, 0.5 * kPlate, 2.0));
    if (kind == Floor::kMesh) {
      add_net(mesh, kFloorCells, kFloorCell, [](double, double) { return 0.0; });
      return std::make_unique<btBvhTriangleMeshShape>(&mesh.triangles(), true);
    }
    constexpr int kPoints = kFloorCells + 1;
    heights.assign(kPoints * kPoints, btScalar(0));
    auto field = std::make_unique<btHeightfieldTerrainShape>(kPoints, kPoints, heights.data(),
                                                             btScalar(-1), btScalar(1), 1, false);
    field->setLocalScaling(bt(kFloorCell, 1.0, kFloorCell));
    return field;
  }
};

struct Rest {
  double early, late;  // m, lowest point after 1.5 s and 2.5 s
};

Rest dropped_on(Floor kind, Representation representation) {
  World world;
  FlatFloor floor;
  world.add(floor.shape(kind), 0.0, {0.0, -0.5 * thickness(kind), 0.0});
  CoSimulation simulation(*world, settings_for(representation));
  simulation.add(make_block(kBlock, {0.02, 0.15 + 0.1, 0.01}));
  Rest rest;
  world.run(1.5, kTick);
  rest.early = lowest_point(simulation.model(0));
  world.run(1.0, kTick);
  EXPECT_FALSE(simulation.failure());
  rest.late = lowest_point(simulation.model(0));
  return rest;
}

// How deep the contact law lets the block sink, m: of its 16 points below each bears a sixteenth of
// it, and those at the corners weigh an eighth of one within.
double depth_at_rest() {
  Lattice lattice;
  add_object(lattice, make_block(kBlock, Vec3::Zero()));
  const double frequency = lattice.objects[0].contact_frequency;
  const double least = *std::min_element(lattice.mass.begin(), lattice.mass.end());
  return kBlock.mass * kGravity / 16.0 / (least * frequency * frequency);
}

// Share of how deep it may lie: what it still moves by (0.08 measured: a proxy is put out of the
// floor by Bullet by 0.8 mm).
constexpr double kTremble = 0.1;

// m: a proxy rests on Bullet's contacts, which come to zero from either side. Of 60 drops, from 20
// heights on each kind of floor, the highest comes to rest 17 um above it.
constexpr double kRoundedTouch = 2e-5;

void expect_at_rest(const Rest& rest) {
  const double depth = depth_at_rest();
  EXPECT_GT(rest.late, -depth);
  EXPECT_LE(rest.late, kRoundedTouch);
  EXPECT_NEAR(rest.late, rest.early, kTremble * depth);
}

class RestingOnFloor : public testing::TestWithParam<std::tuple<Floor, Representation>> {};

TEST_P(RestingOnFloor, IsAsHighAsOnABoxAndGetsNoDeeper) {
  const auto [floor, representation] = GetParam();
  const Rest rest = dropped_on(floor, representation);
  const Rest on_box = dropped_on(Floor::kBox, representation);
  expect_at_rest(rest);
  expect_at_rest(on_box);
  EXPECT_NEAR(rest.late, on_box.late, kTremble * depth_at_rest());
}

std::string name_of(const testing::TestParamInfo<std::tuple<Floor, Representation>>& info) {
  const auto [floor, representation] = info.param;
  const std::string name = floor == Floor::kMesh ? "Mesh" : "Heightfield";
  return name + (representation == Representation::kSwitching ? "" : "AlwaysFlexible");
}

INSTANTIATE_TEST_SUITE_P(Floors, RestingOnFloor,
                         testing::Combine(testing::Values(Floor::kMesh, Floor::kHeightfield),
                                          testing::Values(Representation::kAlwaysFlexible,
                                                          Representation::kSwitching)),
                         name_of);

// Points that have sunk in are beyond it: they know where they came from.
TEST(RestingOn, APlateThinnerThanItSinksIn) {
  for (Representation representation :
       {Representation::kAlwaysFlexible, Representation::kSwitching}) {
    expect_at_rest(dropped_on(Floor::kPlate, representation));
  }
}

}  // namespace
}  // namespace limber::bullet::test
