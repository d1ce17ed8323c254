#include "demos/render/model_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/errors.h"
#include "core/modeller/mesh_lattice.h"
#include "core/modeller/particle_cloud.h"
#include "core/modeller/rope.h"
#include "core/modeller/thin_material.h"
#include "tests/support/blocks.h"
#include "tests/support/meshes.h"

namespace limber::demos {
namespace {

PhysicalModel skinned_ball() {
  MeshLatticeOptions options;
  options.spacing = 1.0;
  MeshLattice made = mesh_lattice(test::icosphere(4, 2, {7, 8, 9}), options);
  PhysicalModel model = test::with_plausible_attributes(std::move(made.geometry), "ball");
  model.skins.push_back(std::move(made.skin));
  return model;
}

TEST(ModelView, StandsOnTheFloorAMetreAcross) {
  for (ModelLook look : {ModelLook::kSkin, ModelLook::kLattice}) {
    const Snapshot s = model_snapshot(skinned_ball(), look);
    Vec3 low = s.bodies[0].surface.points[0], high = low;
    for (const Vec3& p : s.bodies[0].surface.points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    EXPECT_NEAR(low.y(), 0.0, 1e-12);
    EXPECT_NEAR((high - low).maxCoeff(), 1.0, 1e-12);
    EXPECT_NEAR((low + high).x(), 0.0, 1e-12);
  }
}

TEST(ModelView, ShowsTheSkinOrTheCells) {
  const PhysicalModel ball = skinned_ball();
  const auto skin = model_snapshot(ball, ModelLook::kSkin).bodies[0];
  const auto cells = model_snapshot(ball, ModelLook::kLattice).bodies[0];
  EXPECT_EQ(skin.surface.triangles.size(), ball.skins[0].triangles.size());
  EXPECT_EQ(std::count(skin.flexible.begin(), skin.flexible.end(), true), 0);
  EXPECT_EQ(std::count(cells.flexible.begin(), cells.flexible.end(), false), 0);
  EXPECT_TRUE(cells.surface.triangles[0].source.valid());
  EXPECT_THROW(model_snapshot(PhysicalModel{}, ModelLook::kSkin), InputError);
}

// Half a metre of rope 2 cm thick, upright at (3, 5, 1): a metre tall and 4 cm thick in the
// picture, less what its round ends add.
TEST(ModelView, ShowsRopes) {
  Material hemp;
  hemp.density = 1000.0;
  hemp.youngs_modulus = 1e8;
  const std::vector<Vec3> points = {{3, 5, 1}, {3, 5.2, 1}, {3, 5.5, 1}};
  const PhysicalModel model =
      with_rope_material(rope(points, "rope"), "rope", hemp, round_section(0.02));
  const auto body = model_snapshot(model, ModelLook::kSkin).bodies[0];
  ASSERT_EQ(body.strands.size(), 2u);
  const double scale = 1.0 / 0.52;
  EXPECT_NEAR(body.strands[0].radius, 0.01 * scale, 1e-12);
  EXPECT_LT((body.strands[0].a - Vec3(0, 0.01 * scale, 0)).norm(), 1e-12);
  EXPECT_LT((body.strands[1].b - Vec3(0, 0.51 * scale, 0)).norm(), 1e-12);
  EXPECT_FALSE(body.strands[0].flexible);
  EXPECT_TRUE(model_snapshot(model, ModelLook::kLattice).bodies[0].strands[0].flexible);
}

TEST(ModelView, ShowsGrainsThatHaveARadius) {
  const std::vector<Vec3> points = {{0, 0, 0}, {0.1, 0, 0}};
  PhysicalModel model =
      with_particles(particle_cloud(points, "sand"), "sand", ball_particle(2000.0, 0.02));
  EXPECT_EQ(model_snapshot(model, ModelLook::kSkin).bodies[0].strands.size(), 2u);
  model.parts[0].surface.strand_radius = 0.0;
  EXPECT_THROW(model_snapshot(model, ModelLook::kSkin), InputError);
}

}  // namespace
}  // namespace limber::demos
