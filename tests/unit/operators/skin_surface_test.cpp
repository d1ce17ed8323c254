#include "core/operators/skin_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/validate.h"
#include "core/modeller/mesh_lattice.h"
#include "core/operators/boundary_operator.h"
#include "core/operators/breaking_operator.h"
#include "core/operators/gluing_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"
#include "tests/support/meshes.h"

namespace limber {
namespace {

constexpr double kSpacing = 0.25;

PhysicalModel with_skin(const TriangleMesh& mesh, double spacing = kSpacing) {
  MeshLatticeOptions options;
  options.spacing = spacing;
  MeshLattice made = mesh_lattice(mesh, options);
  PhysicalModel model = test::with_plausible_attributes(std::move(made.geometry), mesh.name);
  model.skins.push_back(std::move(made.skin));
  return model;
}

// 4 x 1 x 1 m, 16 x 4 x 4 cells.
PhysicalModel bar() { return with_skin(test::box_mesh({0, 0, 0}, {4, 1, 1})); }

bool is_skin(const SurfaceTriangle& t) { return !t.source.valid(); }

double longest_side(const SurfaceModel& s) {
  double longest = 0.0;
  for (const SurfaceTriangle& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      longest =
          std::max(longest, (s.points[t.corners[k]] - s.points[t.corners[(k + 1) % 3]]).norm());
  return longest;
}

// Breaks every edge of the cells whose middle is within half a cell of the plane x = 2.125: one
// layer is lost.
void cut(PhysicalModel& model) {
  std::vector<EdgeId> edges;
  for (EdgeId e : ids_of(model.edges)) {
    const Edge& edge = model.geometry.edges[e];
    const double x = 0.5 * (model.geometry.points[edge.a].x() + model.geometry.points[edge.b].x());
    if (std::abs(x - 2.125) < 0.1) edges.push_back(e);
  }
  break_edges(model, edges);
}

TEST(SkinSurface, WithoutSkinsIsTheBoundary) {
  const PhysicalModel m = test::block({.cells = {2, 1, 1}});
  const SurfaceModel a = skin_surface(m), b = boundary(m);
  EXPECT_EQ(a.triangles.size(), b.triangles.size());
  EXPECT_EQ(a.source_point, b.source_point);
}

TEST(SkinSurface, IsTheMeshWhileNothingMoved) {
  for (const TriangleMesh& mesh : {test::box_mesh({0, 0, 0}, {4, 1, 1}), test::icosphere(1, 3),
                                   test::torus_mesh(2, 0.6, 40, 20)}) {
    const SurfaceModel s = skin_surface(with_skin(mesh));
    EXPECT_TRUE(std::all_of(s.triangles.begin(), s.triangles.end(), is_skin));
    EXPECT_EQ(test::unmatched_sides(s), 0);
    EXPECT_NEAR(test::enclosed_volume(s), solid_moments(mesh).volume, 1e-12);
  }
}

// x -> A x + b of all points carries the skin along exactly, and rotations are of that kind.
TEST(SkinSurface, FollowsAffineMotionsExactly) {
  Mat3 shear;
  shear << 1.1, 0.2, -0.1, 0.05, 0.9, 0.3, 0.0, -0.2, 1.2;
  const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  const PhysicalModel still = with_skin(test::icosphere(1, 3));
  const SurfaceModel before = skin_surface(still);
  for (const Mat3& a : {shear, turn}) {
    PhysicalModel m = still;
    for (Vec3& x : m.geometry.points) x = a * x + Vec3(3, -4, 5);
    const SurfaceModel after = skin_surface(m);
    ASSERT_EQ(after.points.size(), before.points.size());
    for (std::size_t i = 0; i < after.points.size(); ++i)
      EXPECT_LT((after.points[i] - (a * before.points[i] + Vec3(3, -4, 5))).norm(), 1e-12);
  }
}

// Bent, not broken: vertices are shared whatever cell carries them.
TEST(SkinSurface, StaysClosedWhileItBends) {
  PhysicalModel m = bar();
  for (Vec3& x : m.geometry.points) x.y() += 0.2 * x.x() * x.x();
  EXPECT_EQ(test::unmatched_sides(skin_surface(m)), 0);
}

TEST(SkinSurface, PointsMoveWithTheCellsTheyName) {
  const PhysicalModel m = with_skin(test::icosphere(1, 3));
  const SurfaceModel s = skin_surface(m);
  ASSERT_EQ(s.source_point.size(), s.points.size());
  for (std::size_t i = 0; i < s.points.size(); ++i)
    EXPECT_LT((m.geometry.points[s.source_point[i]] - s.points[i]).norm(), 3 * kSpacing);
}

// The two halves of a cut bar, one of them thrown far away and turned.
TEST(SkinSurface, TearsWithItsLattice) {
  PhysicalModel m = bar();
  const double before = longest_side(skin_surface(m));
  cut(m);
  const Mat3 turn = Eigen::AngleAxisd(1.0, Vec3(0, 1, 0)).toRotationMatrix();
  for (Vec3& x : m.geometry.points)
    if (x.x() > 2.2) x = turn * x + Vec3(10, 20, 30);
  const SurfaceModel s = skin_surface(m);
  // An inner face's side is the diagonal of a cell's square.
  EXPECT_LE(longest_side(s), std::max(before, std::sqrt(2.0) * kSpacing) + 1e-12);
  const auto skin = std::count_if(s.triangles.begin(), s.triangles.end(), is_skin);
  const auto whole = skin_surface(bar()).triangles.size();
  EXPECT_LT(skin, static_cast<long>(whole));
  EXPECT_GT(skin, static_cast<long>(whole * 8 / 10));
  for (const SurfaceTriangle& t : s.triangles) EXPECT_EQ(t.exposed_by_breaking, !is_skin(t));
  // Two new ends of 4 x 4 squares, two triangles each.
  EXPECT_EQ(static_cast<long>(s.triangles.size()) - skin, 2 * 4 * 4 * 2);
}

TEST(SkinSurface, VanishesWithTheLastCell) {
  PhysicalModel m = bar();
  std::vector<EdgeId> all;
  for (EdgeId e : ids_of(m.edges)) all.push_back(e);
  break_edges(m, all);
  EXPECT_TRUE(skin_surface(m).triangles.empty());
}

// A skin beside an object without: each shows what it has, named after its own part.
TEST(SkinSurface, IsKeptByGlue) {
  const PhysicalModel plain =
      test::block({.cells = {2, 4, 4}, .spacing = kSpacing, .name = "plain"});
  PhysicalModel skinned = bar();
  place(skinned, Mat3::Identity(), Vec3(0.6, 0, 0));
  const PhysicalModel both = glue(plain, skinned, {.distance = 0.15, .stiffness = 10}).model;
  EXPECT_TRUE(validate(both).empty());
  ASSERT_EQ(both.skins.size(), 1u);
  const SurfaceModel s = skin_surface(both), alone = skin_surface(skinned);
  const auto skin = std::count_if(s.triangles.begin(), s.triangles.end(), is_skin);
  EXPECT_EQ(skin, static_cast<long>(alone.triangles.size()));
  EXPECT_EQ(s.triangles.size(), alone.triangles.size() + boundary(plain).triangles.size());
  for (const SurfaceTriangle& t : s.triangles) EXPECT_EQ(t.subobject, is_skin(t) ? 1 : 0);
  EXPECT_NEAR(test::enclosed_volume(s), 4.0 + 32 * std::pow(kSpacing, 3), 1e-12);
}

}  // namespace
}  // namespace limber
