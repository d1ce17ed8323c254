#include "core/modeller/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/modeller/mesh_defects.h"
#include "core/modeller/mesh_refinement.h"
#include "core/modeller/mesh_repair.h"
#include "tests/support/meshes.h"

namespace limber {
namespace {

constexpr double kPi = std::numbers::pi;

// A box of sides a, b, c: I_x = V (b^2 + c^2) / 12.
TEST(SolidMoments, OfABoxAreThoseOfTheTextbook) {
  const SolidMoments m = solid_moments(test::box_mesh({10, 20, 30}, {12, 23, 34}));
  EXPECT_NEAR(m.volume, 24.0, 1e-12);
  EXPECT_LT((m.centre - Vec3(11, 21.5, 32)).norm(), 1e-12);
  const Mat3 expected = Vec3(24.0 * 25 / 12, 24.0 * 20 / 12, 24.0 * 13 / 12).asDiagonal();
  EXPECT_LT((m.inertia - expected).norm(), 1e-10);
}

// Turned bodies have turned tensors: I' = R I R^T.
TEST(SolidMoments, TurnWithTheBody) {
  const TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 2, 5});
  const Mat3 r = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const SolidMoments still = solid_moments(box);
  const SolidMoments turned = solid_moments(test::moved(box, r, {4, 5, 6}));
  EXPECT_LT((turned.inertia - r * still.inertia * r.transpose()).norm(), 1e-12);
  EXPECT_LT((turned.centre - (r * still.centre + Vec3(4, 5, 6))).norm(), 1e-12);
}

// A sphere's volume 4/3 pi and inertia 2/5 V from below, four times as near with every quartering;
// a torus's 2 pi^2 R r^2 and about its axis V (R^2 + 3/4 r^2).
TEST(SolidMoments, ApproachThoseOfRoundBodies) {
  const double v3 = solid_moments(test::icosphere(1, 3)).volume;
  const double v4 = solid_moments(test::icosphere(1, 4)).volume;
  const double exact = 4.0 / 3.0 * kPi;
  EXPECT_NEAR((exact - v3) / (exact - v4), 4.0, 0.05);
  EXPECT_NEAR(solid_moments(test::icosphere(1, 5)).inertia(0, 0), 0.4 * exact, 3e-3);
  const SolidMoments torus = solid_moments(test::torus_mesh(2, 0.5, 200, 100));
  const double volume = 2 * kPi * kPi * 2 * 0.25;
  EXPECT_NEAR(torus.volume / volume, 1.0, 1e-3);
  EXPECT_NEAR(torus.inertia(1, 1) / (volume * (4 + 0.75 * 0.25)), 1.0, 2e-3);
}

TEST(SolidMoments, OfAnInvertedMeshAreNegative) {
  EXPECT_NEAR(solid_moments(test::inside_out(test::box_mesh({0, 0, 0}, {1, 1, 1}))).volume, -1,
              1e-15);
}

TEST(MeshDefects, FindNothingInAClosedMesh) {
  const MeshDefects d = mesh_defects(test::torus_mesh(2, 0.5, 12, 8));
  EXPECT_TRUE(d.closed());
  EXPECT_EQ(d.open_edges + d.inconsistent_edges + d.non_manifold_edges + d.doubled_triangles, 0u);
  EXPECT_EQ(d.parts, 1u);
  EXPECT_EQ(d.missing_area, 0.0);
}

TEST(MeshDefects, MeasureAHole) {
  TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 2, 3});
  box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 2);  // the side of 2 x 3
  const MeshDefects d = mesh_defects(box);
  EXPECT_EQ(d.open_edges, 4u);
  EXPECT_NEAR(d.missing_area, 6.0, 1e-12);
}

// A tube's two ends point opposite ways and must not cancel.
TEST(MeshDefects, MeasureTwoHoles) {
  TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 2, 3});
  box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 4);
  EXPECT_NEAR(mesh_defects(box).missing_area, 12.0, 1e-12);
}

TEST(MeshDefects, CountWhatIsBroken) {
  TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 1, 1});
  box.triangles.push_back(box.triangles[3]);  // doubled: its edges have three triangles
  std::swap(box.triangles[0][1], box.triangles[0][2]);
  box.triangles.push_back({0, 1, 1});
  const MeshDefects d = mesh_defects(box);
  EXPECT_EQ(d.doubled_triangles, 1u);
  EXPECT_EQ(d.degenerate_triangles, 1u);
  EXPECT_EQ(d.inconsistent_edges, 3u);
  EXPECT_GE(d.non_manifold_edges, 3u);
  EXPECT_FALSE(d.closed());

  box.positions[2].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mesh_defects(box).non_finite_positions, 1u);
  box.triangles.push_back({0, 1, 8});
  box.triangles.push_back({0, -1, 2});
  EXPECT_EQ(mesh_defects(box).missing_corners, 2u);
}

TEST(MeshRepair, JoinsSoup) {
  const RepairedMesh r = repaired(test::soup(test::icosphere(1, 2)));
  EXPECT_EQ(r.mesh.positions.size(), 162u);
  EXPECT_EQ(r.joined_positions, 3 * 320u - 162);
  EXPECT_TRUE(mesh_defects(r.mesh).closed());
}

TEST(MeshRepair, TurnsWhatRunsAgainstItsNeighbours) {
  const RepairedMesh r = repaired(test::with_flipped(test::icosphere(1, 2), 3));
  EXPECT_EQ(r.turned_triangles, 107u);  // every third of 320
  EXPECT_TRUE(mesh_defects(r.mesh).closed());
  EXPECT_GT(solid_moments(r.mesh).volume, 4.0);
}

TEST(MeshRepair, TurnsAMeshThatIsInsideOut) {
  const RepairedMesh r = repaired(test::inside_out(test::icosphere(1, 2)));
  EXPECT_TRUE(r.turned_whole);
  EXPECT_GT(solid_moments(r.mesh).volume, 4.0);
}

// A shell is a sphere in a sphere that faces inwards; a ball beside it that does so is a mistake.
TEST(MeshRepair, KeepsCavitiesAndTurnsInvertedParts) {
  const TriangleMesh shell =
      test::together(test::icosphere(1, 3), test::inside_out(test::icosphere(0.5, 3)));
  const RepairedMesh kept = repaired(shell);
  EXPECT_EQ(kept.turned_parts, 0u);
  EXPECT_NEAR(solid_moments(kept.mesh).volume, solid_moments(shell).volume, 1e-12);

  const TriangleMesh ball = test::inside_out(test::icosphere(0.5, 3, {3, 0, 0}));
  const RepairedMesh turned = repaired(test::together(shell, ball));
  EXPECT_EQ(turned.turned_parts, 1u);
  EXPECT_NEAR(solid_moments(turned.mesh).volume,
              solid_moments(shell).volume - solid_moments(ball).volume, 1e-12);
}

TEST(MeshRefinement, SplitsEdgesWithoutMovingTheSurface) {
  const TriangleMesh box = test::box_mesh({0, 0, 0}, {1, 2, 5});
  const RefinedMesh made = refined(box, 0.4, 100000);
  const TriangleMesh& fine = made.mesh;
  EXPECT_LE(made.longest_edge, 0.4);
  for (const MeshTriangle& t : fine.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE((fine.positions[t[k]] - fine.positions[t[(k + 1) % 3]]).norm(), 0.4);
  EXPECT_TRUE(mesh_defects(fine).closed());
  EXPECT_EQ(mesh_defects(fine).degenerate_triangles, 0u);
  EXPECT_NEAR(surface_area(fine), 34.0, 1e-12);
  EXPECT_LT((solid_moments(fine).inertia - solid_moments(box).inertia).norm(), 1e-11);
}

TEST(MeshRefinement, StopsBeforeTooManyTriangles) {
  const RefinedMesh made = refined(test::box_mesh({0, 0, 0}, {1, 1, 1}), 1e-9, 1000);
  // 12, 48, 192, 768: every round halves all edges, the diagonals of the sides too.
  EXPECT_EQ(made.mesh.triangles.size(), 768u);
  EXPECT_DOUBLE_EQ(made.longest_edge, std::sqrt(2.0) / 8.0);
  EXPECT_TRUE(mesh_defects(made.mesh).closed());
}

}  // namespace
}  // namespace limber
