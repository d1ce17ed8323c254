#include "demos/render/model_view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/errors.h"
#include "core/modeller/mesh_lattice.h"
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

}  // namespace
}  // namespace limber::demos
