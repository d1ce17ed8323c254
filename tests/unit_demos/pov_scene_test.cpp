#include "demos/render/pov_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/model/errors.h"
#include "demos/render/crease_normals.h"
#include "demos/render/pov_mesh.h"
#include "demos/render/pov_text.h"
#include "tests/support/temporary_folder.h"

namespace limber::demos {
namespace {

using test::contents;
using test::TemporaryFolder;
using test::write;
using testing::HasSubstr;
using testing::Not;

// Two triangles that share the edge 0-1: the floor and a wall that leans by `bend` from it.
SurfaceModel folded_sheet(double bend_rad) {
  SurfaceModel s;
  s.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-std::cos(bend_rad), std::sin(bend_rad), 0}};
  s.triangles = {{{0, 1, 2}, FaceId(), 0, false}, {{0, 3, 1}, FaceId(), 0, false}};
  s.subobject_names = {"sheet"};
  s.subobject_surfaces.resize(1);
  return s;
}

Snapshot snapshot_of(SurfaceModel surface) {
  Snapshot snapshot;
  const std::size_t n = surface.triangles.size();
  snapshot.bodies.push_back({"sheet", std::move(surface), std::vector<bool>(n, false)});
  return snapshot;
}

// The length that precedes a POV-Ray list: "vertex_vectors { 4,".
int first_number_after(const std::string& text, const std::string& word) {
  const auto at = text.find(word + " { ");
  return at == std::string::npos ? -1 : std::atoi(text.c_str() + at + word.size() + 3);
}

TEST(CreaseNormals, AreSharedAcrossAGentleBend) {
  const auto normals = crease_normals(folded_sheet(0.2), 0.9);
  EXPECT_LT((normals[0][0] - normals[1][0]).norm(), 1e-12);
  // The bend turns the second normal by 0.2 rad; both corners are right angles: half of it.
  EXPECT_NEAR(std::acos(normals[0][0].dot(normals[0][2])), 0.1, 1e-6);
}

TEST(CreaseNormals, StaySharpAcrossACrease) {
  const auto normals = crease_normals(folded_sheet(1.2), 0.9);
  EXPECT_NEAR(std::acos(normals[0][0].dot(normals[1][0])), 1.2, 1e-6);
}

TEST(CreaseNormals, StaySharpAtABreakAndBetweenSubobjects) {
  SurfaceModel broken = folded_sheet(0.2);
  broken.triangles[1].exposed_by_breaking = true;
  EXPECT_NEAR(std::acos(crease_normals(broken, 0.9)[0][0].y()), 0.0, 1e-6);
  SurfaceModel glued = folded_sheet(0.2);
  glued.triangles[1].subobject = 1;
  EXPECT_NEAR(std::acos(crease_normals(glued, 0.9)[0][0].y()), 0.0, 1e-6);
}

TEST(PovScene, HoldsEveryTriangle) {
  const std::string text = pov_scene(snapshot_of(folded_sheet(0.2)), {});
  EXPECT_EQ(first_number_after(text, "vertex_vectors"), 4);
  EXPECT_EQ(first_number_after(text, "face_indices"), 2);
  EXPECT_EQ(first_number_after(text, "normal_vectors"), 6);
  EXPECT_EQ(first_number_after(text, "texture_list"), 4);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, Not(HasSubstr("inf")));
}

TEST(PovScene, LeavesOutTrianglesWithoutArea) {
  SurfaceModel surface = folded_sheet(0.2);
  surface.triangles.push_back({{0, 1, 1}, FaceId(), 0, false});
  EXPECT_EQ(first_number_after(pov_scene(snapshot_of(surface), {}), "face_indices"), 2);
  EXPECT_EQ(pov_body({"empty", SurfaceModel{}, {}}), "");
}

TEST(PovScene, RefusesWhatIsNotFinite) {
  SurfaceModel surface = folded_sheet(0.2);
  surface.points[1].x() = std::nan("");
  EXPECT_THROW(pov_scene(snapshot_of(surface), {}), SimulationError);
}

TEST(PovScene, TellsTheStatesOfATriangleApart) {
  Snapshot snapshot = snapshot_of(folded_sheet(0.2));
  const std::string rigid = pov_body(snapshot.bodies[0]);
  EXPECT_THAT(rigid, HasSubstr("face_indices { 2,<0,1,2>,0,<0,3,1>,0 }"));
  EXPECT_THAT(rigid, Not(HasSubstr("cylinder")));
  snapshot.bodies[0].flexible = {true, true};
  snapshot.bodies[0].surface.triangles[1].exposed_by_breaking = true;
  const std::string flexible = pov_body(snapshot.bodies[0]);
  EXPECT_THAT(flexible, HasSubstr("face_indices { 2,<0,1,2>,1,<0,3,1>,3 }"));
  EXPECT_THAT(flexible, HasSubstr("cylinder"));
}

// The first triangle is of clear glass, the second opaque: two meshes, one of them with an
// interior.
TEST(PovScene, RefractsLightInWhatIsTransparent) {
  EXPECT_THAT(pov_scene(snapshot_of(folded_sheet(0.2)), {}), Not(HasSubstr("interior")));
  SurfaceModel surface = folded_sheet(0.2);
  surface.subobject_names = {"window", "frame"};
  surface.subobject_surfaces.resize(2);
  surface.subobject_surfaces[0].transparency = 0.9;
  surface.subobject_surfaces[0].index_of_refraction = 1.33;
  surface.triangles[1].subobject = 1;
  const std::string text = pov_body(snapshot_of(surface).bodies[0]);
  const auto second = text.find("mesh2", 1);
  ASSERT_NE(second, std::string::npos);
  EXPECT_THAT(text.substr(0, second), HasSubstr("face_indices { 1,<0,3,1>,4 }"));
  EXPECT_THAT(text.substr(0, second), Not(HasSubstr("interior")));
  EXPECT_THAT(text.substr(second), HasSubstr("face_indices { 1,<0,1,2>,0 }"));
  EXPECT_THAT(text.substr(second), HasSubstr("interior { ior 1.33 }"));
  EXPECT_THAT(text.substr(second), HasSubstr("transmit 0.9"));
}

TEST(PovScene, WritesTheImagesOfTheAxesAsRows) {
  Snapshot snapshot;
  Mat3 quarter_turn_about_y;
  quarter_turn_about_y << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // x -> -z, z -> x
  snapshot.rigid.push_back(
      {rigid_box("b", Vec3(1, 1, 1), Vec3::Zero(), 0.0), Vec3(7, 8, 9), quarter_turn_about_y});
  EXPECT_THAT(pov_scene(snapshot, {}), HasSubstr("matrix <0,0,-1, 0,1,0, 1,0,0, 7,8,9>"));
}

TEST(PovScene, HasAFloorOnlyWhereTheSceneHasOne) {
  Snapshot snapshot;
  EXPECT_THAT(pov_scene(snapshot, {}), HasSubstr("plane"));
  snapshot.floor = false;
  EXPECT_THAT(pov_scene(snapshot, {}), Not(HasSubstr("plane")));
}

TEST(PovScene, TurnsTheCameraToTheRightHandedSide) {
  EXPECT_THAT(pov_scene(Snapshot{}, {960, 600}), HasSubstr("right -x*1.6"));
}

TEST(PovScene, CanLookStraightDown) {
  Snapshot snapshot;
  snapshot.camera.position = {0.0, 2.0, 0.0};
  snapshot.camera.target = Vec3::Zero();
  EXPECT_THAT(pov_scene(snapshot, {}), HasSubstr("sky <0,0,-1>"));
}

TEST(PovColour, StaysWithinWhatAScreenCanShow) {
  EXPECT_EQ(pov_colour(Vec3(-1.0, 0.5, 2.0)), "rgb <0,0.5,1>");
}

// Sum of red minus blue over each half of a binary PPM with one byte per channel.
struct Redness {
  long left = 0, right = 0;
};

// The pixels are the last bytes: the header before them holds comments of any length.
Redness redness(const std::string& ppm, std::size_t width, std::size_t height) {
  Redness sum;
  if (ppm.size() < 3 * width * height) return sum;
  const auto* pixels =
      reinterpret_cast<const unsigned char*>(ppm.data() + ppm.size()) - 3 * width * height;
  for (std::size_t i = 0; i < width * height; ++i) {
    (i % width < width / 2 ? sum.left : sum.right) += pixels[3 * i] - pixels[3 * i + 2];
  }
  return sum;
}

TEST(PovScene, IsNotMirrored) {
  if (std::system("povray --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no POV-Ray";
  Snapshot snapshot;
  snapshot.camera = {{0.0, 1.0, 4.0}, {0.0, 0.5, 0.0}, 40.0};
  // +x is right, seen from +z
  RigidBody red = rigid_box("red", Vec3(0.4, 0.4, 0.4), Vec3(0.8, 0.4, 0.0), 0.0);
  red.colour = {0.9, 0.02, 0.02};
  snapshot.rigid.push_back({red, red.centre, Mat3::Identity()});
  const TemporaryFolder folder;
  write(folder / "scene.pov", pov_scene(snapshot, {60, 40}));
  const std::string command =
      "cd '" + (folder / "").string() +
      "' && povray +Iscene.pov +Oimage.ppm +FP8 +W60 +H40 -D >/dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const Redness sum = redness(contents(folder / "image.ppm"), 60, 40);
  EXPECT_GT(sum.right, 2 * std::abs(sum.left));
  EXPECT_GT(sum.right, 1000);
}

}  // namespace
}  // namespace limber::demos
