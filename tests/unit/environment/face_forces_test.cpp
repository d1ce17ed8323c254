#include "core/environment/face_forces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/operators/boundary_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr FaceAttributes kDrag{DragLaw::kQuadratic, 1.2, 0.1};

PhysicalModel with_drag(PhysicalModel model, const FaceAttributes& drag = kDrag) {
  for (FaceAttributes& face : model.faces) face = drag;
  return model;
}

std::vector<std::int32_t> indices(const std::vector<DragFace>& faces) {
  std::vector<std::int32_t> found;
  for (const DragFace& face : faces) found.push_back(face.face);
  return found;
}

std::vector<std::int32_t> points_from(std::int32_t first, std::int32_t end) {
  std::vector<std::int32_t> points(static_cast<std::size_t>(end - first));
  std::iota(points.begin(), points.end(), first);
  return points;
}

Vec3 sum(const std::vector<Vec3>& forces) {
  return std::accumulate(forces.begin(), forces.end(), Vec3(Vec3::Zero()));
}

// Forces on all points, N.
std::vector<Vec3> forces_on(const Lattice& lattice, const Air& air) {
  std::vector<Vec3> forces(lattice.motion.size(), Vec3::Zero());
  const auto faces = faces_in_air(lattice, PointRole::kDynamic);
  add_face_forces(faces, air, 0.0, lattice.motion, forces);
  return forces;
}

// ---- which faces -------------------------------------------------------------------------------

// 3 x 2 x 1 cells: 2 (6 + 3 + 2) squares outside, of 6 * 6 all in all.
TEST(FacesInAir, AreTheOuterOnesOfABlock) {
  const Lattice lattice = test::lattice_of({with_drag(test::block({.cells = {3, 2, 1}}))});
  EXPECT_EQ(faces_in_air(lattice, PointRole::kDynamic).size(), 2u * 2u * (6u + 3u + 2u));
}

// The boundary operator finds what is seen of a broken model by another rule, from scratch.
TEST(FacesInAir, OfABrokenBlockAreItsBoundary) {
  const test::BlockShape shape{.cells = {3, 3, 3}};
  Lattice lattice = test::lattice_of({with_drag(test::block(shape))});
  const std::int32_t in_the_middle =
      test::block_edge(lattice.objects[0].authored, shape, {1, 1, 1}, {2, 1, 1}).value;
  const std::size_t before = faces_in_air(lattice, PointRole::kDynamic).size();
  break_edges(lattice.topology, lattice.breaking, {&in_the_middle, 1});
  const std::size_t after = faces_in_air(lattice, PointRole::kDynamic).size();
  EXPECT_EQ(after, boundary(extract_model(lattice, 0)).triangles.size());
  EXPECT_NE(after, before);
}

TEST(FacesInAir, OfASheetVanishWithASideThatBreaks) {
  Lattice lattice = test::lattice_of({with_drag(test::sheet(1, false))});
  const std::vector<DragFace> faces = faces_in_air(lattice, PointRole::kDynamic);
  ASSERT_THAT(indices(faces), ElementsAre(0, 1));
  // An edge of the second triangle alone.
  const std::vector<std::int32_t> first{faces[0].a, faces[0].b, faces[0].c};
  const auto of_first = [&](std::int32_t p) { return std::ranges::find(first, p) != first.end(); };
  std::int32_t side = 0;
  while (of_first(lattice.springs[side].a) && of_first(lattice.springs[side].b)) ++side;
  break_edges(lattice.topology, lattice.breaking, {&side, 1});
  EXPECT_THAT(indices(faces_in_air(lattice, PointRole::kDynamic)), ElementsAre(0));
}

TEST(FacesInAir, NeedADragCoefficient) {
  PhysicalModel sheet = test::sheet(1, false);
  EXPECT_THAT(faces_in_air(test::lattice_of({sheet}), PointRole::kDynamic), IsEmpty());
  sheet.faces[FaceId(1)] = kDrag;
  const Lattice lattice = test::lattice_of({sheet});
  EXPECT_THAT(indices(faces_in_air(lattice, PointRole::kDynamic)), ElementsAre(1));
}

TEST(FacesInAir, HaveAllCornersInTheRole) {
  Lattice lattice = test::lattice_of({with_drag(test::sheet(1, false))});
  const DragFace first = faces_in_air(lattice, PointRole::kDynamic)[0];
  for (std::int32_t p : {first.a, first.b, first.c}) lattice.role[p] = PointRole::kIdle;
  EXPECT_THAT(faces_in_air(lattice, PointRole::kDynamic), IsEmpty());
  EXPECT_THAT(indices(faces_in_air(lattice, PointRole::kIdle)), ElementsAre(0));
}

// The second of two objects: 4 points and 2 faces after the first one's.
TEST(FacesInAir, AreThoseOfTheGivenPointsInAnyObject) {
  const PhysicalModel sheet = with_drag(test::sheet(1, false));
  const Lattice lattice = test::lattice_of({sheet, sheet});
  EXPECT_THAT(indices(faces_in_air(lattice, points_from(0, 4))), ElementsAre(0, 1));
  const std::vector<DragFace> second = faces_in_air(lattice, points_from(4, 8));
  EXPECT_THAT(indices(second), ElementsAre(2, 3));
  for (const DragFace& face : second) EXPECT_GE(std::min({face.a, face.b, face.c}), 4);
  EXPECT_THAT(indices(faces_in_air(lattice, points_from(0, 8))), ElementsAre(0, 1, 2, 3));
  const std::vector<std::int32_t> three = {second[1].a, second[1].b, second[1].c};
  std::vector<std::int32_t> ascending = three;
  std::sort(ascending.begin(), ascending.end());
  EXPECT_THAT(indices(faces_in_air(lattice, ascending)), ElementsAre(3));
  EXPECT_THAT(faces_in_air(lattice, points_from(3, 5)), IsEmpty());
}

// ---- their forces ------------------------------------------------------------------------------

// A square metre of two triangles across 3 m/s: rho/2 C u^2 = 1.225 / 2 * 1.2 * 9 N. The corners on
// the diagonal belong to both triangles and bear a third of it each, the others a sixth.
TEST(FaceForces, OnASheetAcrossTheWindAreItsDynamicPressure) {
  const Lattice lattice = test::lattice_of({with_drag(test::sheet(1, false))});
  const Air air{.wind = {{uniform_flow({0, 0, 3})}}};
  const std::vector<Vec3> forces = forces_on(lattice, air);
  constexpr double whole = 0.5 * 1.225 * 1.2 * 9.0;
  EXPECT_NEAR((sum(forces) - Vec3(0, 0, whole)).norm(), 0.0, 1e-14);
  std::vector<double> along;
  for (const Vec3& f : forces) along.push_back(f.z());
  std::sort(along.begin(), along.end());
  for (int i : {0, 1}) EXPECT_NEAR(along[i], whole / 6.0, 1e-14);
  for (int i : {2, 3}) EXPECT_NEAR(along[i], whole / 3.0, 1e-14);
}

// Front and back of a cube of n^3 cells: twice the pressure on L^2, however fine.
TEST(FaceForces, OnABlockDoNotDependOnItsResolution) {
  const Air air{.density = 1.0, .wind = {{uniform_flow({5, 0, 0})}}};
  for (int n : {1, 2, 4}) {
    const PhysicalModel block = test::block({.cells = {n, n, n}, .spacing = 2.0 / n});
    const FaceAttributes normal_only{DragLaw::kQuadratic, 1.0, 0.0};
    const Lattice lattice = test::lattice_of({with_drag(block, normal_only)});
    EXPECT_LE((sum(forces_on(lattice, air)) - Vec3(2.0 * 0.5 * 4.0 * 25.0, 0, 0)).norm(), 1e-12);
  }
}

// A wind that changes along x is felt where the centroid is, at its own time.
TEST(FaceForces, TakeTheWindAtTheCentroidAndAtTheTime) {
  PhysicalModel sheet = test::sheet(1, false);
  sheet.faces[FaceId(0)] = {DragLaw::kLinear, 1.0, 1.0};
  const Lattice lattice = test::lattice_of({sheet});
  const DragFace face = faces_in_air(lattice, PointRole::kDynamic)[0];
  FlowPrimitive source;
  source.kind = FlowKind::kPointSource;
  source.position = Vec3(0.2, -3.0, 1.0);
  source.strength = Track<double>({{0.0, 0.0}, {1.0, 7.0}});
  const auto x = [&](std::int32_t p) { return lattice.motion[p].position; };
  const Vec3 r = (x(face.a) + x(face.b) + x(face.c)) / 3.0 - Vec3(0.2, -3.0, 1.0);
  const Vec3 wind = 0.5 * 7.0 / (4.0 * M_PI * std::pow(r.norm(), 3)) * r;
  std::vector<Vec3> forces(4, Vec3::Zero());
  add_face_forces({&face, 1}, Air{.wind = {{source}}}, 0.5, lattice.motion, forces);
  EXPECT_LE((sum(forces) - 0.5 * wind).norm(), 1e-15);  // area 1/2 m^2
}

// A plate that spins about its own normal in still air is braked by skin friction alone: linear
// drag dF = -C_T v dA at the centroids.
TEST(RigidFaceWrench, OfASpinningPlateIsAPureBrakingTorque) {
  const FaceAttributes drag{DragLaw::kLinear, 3.0, 0.5};
  const std::vector<BodyFace> faces = {
      body_face({Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 0)}, drag),
      body_face({Vec3(0, 0, 0), Vec3(-3, 0, 0), Vec3(0, -3, 0)}, drag)};
  BodyMotion body;
  body.centre = {7, 8, 9};
  body.angular_velocity = {0, 0, 2};
  const Wrench wrench = rigid_face_wrench(faces, body, Air{}, 0.0);
  EXPECT_LE(wrench.force.norm(), 1e-14);
  // Centroids (1, 1) and (-1, -1), areas 4.5: torque -2 * C_T * A * r^2 * omega = -18.
  EXPECT_LE((wrench.torque - Vec3(0, 0, -18.0)).norm(), 1e-13);
}

}  // namespace
}  // namespace limber
