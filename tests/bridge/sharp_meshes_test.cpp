#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "bullet_bridge/shapes/sharp_corners.h"
#include "tests/bridge/measure.h"
#include "tests/bridge/shapes.h"
#include "tests/bridge/sheets.h"
#include "tests/bridge/world.h"

// What stands out of a triangle mesh and is thinner than a lattice's cells: faces meet it, no point
// does.

namespace limber::bullet::test {
namespace {

constexpr double kHeight = 0.4;  // m, of what stands out
constexpr double kCell = 0.1;    // m

// With four sides and a base of 4 cm.
void add_spike(Mesh& mesh, double x, double z) {
  constexpr double kHalf = 0.02;  // m
  const Vec3 tip(x, kHeight, z);
  const Vec3 base[4] = {{x - kHalf, 0, z - kHalf},
                        {x - kHalf, 0, z + kHalf},
                        {x + kHalf, 0, z + kHalf},
                        {x + kHalf, 0, z - kHalf}};
  for (int i = 0; i < 4; ++i) mesh.add(tip, base[i], base[(i + 1) % 4]);
  mesh.add(base[0], base[2], base[1]);
  mesh.add(base[0], base[3], base[2]);
}

std::vector<SharpCorner> corners_of(Mesh& mesh) {
  return sharp_corners(*only_part(mesh.shape()).triangles);
}

// Its tip; those of its base are as sharp: the sides stand at 87 degrees to it.
TEST(SharpCorners, ASpikeHasItsTipAndThoseOfItsBase) {
  Mesh mesh;
  add_spike(mesh, 0.0, 0.0);
  const std::vector<SharpCorner> found = corners_of(mesh);
  ASSERT_EQ(found.size(), 5u);
  const auto tip = std::find_if(found.begin(), found.end(), [](const SharpCorner& c) {
    return c.corners.back().y() > 0.5 * kHeight;
  });
  ASSERT_NE(tip, found.end());
  EXPECT_EQ(tip->corners.size(), 5u);
  EXPECT_GT(tip->facing.normalized().y(), 0.999);
}

TEST(SharpCorners, GroundPitsAndMeshesInsideOutHaveNone) {
  Mesh ground;
  add_net(ground, 6, 0.5, [](double x, double z) { return 0.2 * x * z; });
  EXPECT_TRUE(corners_of(ground).empty());
  Mesh pit;  // but its rim
  add_net(pit, 6, 0.5, [](double x, double z) { return x == 0.0 && z == 0.0 ? -2.0 : 0.0; });
  for (const ContactPart& part : all_parts(pit.shape(), 3.0)) {
    if (!part.for_faces) continue;
    EXPECT_LT(penetration(part, {0.0, -1.0, 0.0}).depth, 0.0);
  }
  Mesh spike, inside_out;
  add_spike(spike, 0.0, 0.0);
  for (const Triangle& t : spike.corners) inside_out.add(t[0], t[2], t[1]);
  EXPECT_TRUE(corners_of(inside_out).empty());
}

TEST(SharpCorners, ARidgeWithoutCornersOfItsOwnCountsOnce) {
  Mesh roof;  // open at both ends
  roof.add({0, 1, -1}, {-0.1, 0, -1}, {-0.1, 0, 1});
  roof.add({0, 1, -1}, {-0.1, 0, 1}, {0, 1, 1});
  roof.add({0, 1, -1}, {0, 1, 1}, {0.1, 0, 1});
  roof.add({0, 1, -1}, {0.1, 0, 1}, {0.1, 0, -1});
  const std::vector<SharpCorner> found = corners_of(roof);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(found[0].facing.normalized().y(), 0.999);
}

struct Fall {
  double lowest = 1e300;     // m, of the sheet at the places that are asked for
  double most_energy = 0.0;  // J above the start
};

// A static body of a mesh.
class MeshBody {
 public:
  MeshBody(World& world, Mesh& mesh)
      : world_(world),
        body_(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &shape_of(mesh))) {
    world_->addRigidBody(&body_);
  }
  ~MeshBody() { world_->removeRigidBody(&body_); }
  MeshBody(const MeshBody&) = delete;
  MeshBody& operator=(const MeshBody&) = delete;

 private:
  static btCollisionShape& shape_of(Mesh& mesh) {
    return const_cast<btBvhTriangleMeshShape&>(mesh.shape());
  }

  World& world_;
  btRigidBody body_;
};

// A sheet with cells of 10 cm, from 5 cm above. It does not bend by itself: hung over what stands
// out it folds and slides off after half a second.
Fall drop_sheet(Mesh& mesh, const std::vector<Vec3>& places) {
  World world;
  const MeshBody body(world, mesh);
  Fall fall;
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  PhysicalModel sheet = level_sheet(8, 8 * kCell);
  place(sheet, Mat3::Identity(), {0.0, kHeight + 0.05, 0.0});
  const double at_first = sums_of(sheet).energy(kGravity);
  simulation.add(sheet);
  for (int tick = 0; tick < 24; ++tick) {
    world.step(kTick);
    const PhysicalModel now = simulation.model(0);
    for (const Vec3& p : places) fall.lowest = std::min(fall.lowest, height_at(now, p.x(), p.z()));
    fall.most_energy = std::max(fall.most_energy, sums_of(now).energy(kGravity) - at_first);
  }
  EXPECT_FALSE(simulation.failure());
  return fall;
}

// In the middle of cells, a little off their diagonals.
const std::vector<Vec3> kTips = {
    {0.26, 0.0, 0.23}, {0.24, 0.0, -0.27}, {-0.26, 0.0, 0.23}, {-0.24, 0.0, -0.27}};

TEST(SharpMesh, SpikesHoldASheetBetweenItsPoints) {
  Mesh mesh;
  for (const Vec3& tip : kTips) add_spike(mesh, tip.x(), tip.z());
  const Fall fall = drop_sheet(mesh, kTips);
  EXPECT_GT(fall.lowest, kHeight - 0.2 * kCell);
  EXPECT_LT(fall.most_energy, 1e-3);
}

TEST(SharpMesh, APlateComesToRestOnSpikes) {
  World world;
  Mesh mesh;
  for (const Vec3& tip : kTips) add_spike(mesh, tip.x() - 0.2, tip.z() - 0.2);
  const MeshBody body(world, mesh);
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block({.cells = {8, 1, 8},
                             .mass = 5.0,
                             .modulus = 1e6,
                             .damping_ratio = 0.2,
                             .internal_damping = 5.0},
                            {-0.2, kHeight + 0.08, -0.2}));
  world.run(2.0, kTick);
  ASSERT_FALSE(simulation.failure());
  const Sums sums = sums_of(simulation.model(0));
  EXPECT_LT(sums.velocity().norm(), 0.02);
  EXPECT_GT(sums.centre().y(), kHeight);
}

// Of 2 cm, upright: longer than the sheet, and its points are on both sides.
TEST(SharpMesh, AWallHoldsASheetAlongItsRidge) {
  Mesh box;
  add_box(box, {0.5, 0.5 * kHeight, 0.01});
  Mesh wall;
  for (const Triangle& t : box.corners) {
    const Vec3 up(0.0, 0.5 * kHeight, 0.05);
    wall.add(t[0] + up, t[1] + up, t[2] + up);
  }
  const Fall fall = drop_sheet(wall, {{0.03, 0.0, 0.05}, {0.17, 0.0, 0.05}});
  EXPECT_GT(fall.lowest, kHeight - 0.2 * kCell);
  EXPECT_LT(fall.most_energy, 1e-3);
}

}  // namespace
}  // namespace limber::bullet::test
