#include "core/operators/boundary_operator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/operators/breaking_operator.h"
#include "core/operators/gluing_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"

namespace limber {
namespace {

using test::block;
using test::sheet;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Vec3 centre(const SurfaceModel& s, const SurfaceTriangle& t) {
  return (s.points[t.corners[0]] + s.points[t.corners[1]] + s.points[t.corners[2]]) / 3.0;
}

Vec3 normal(const SurfaceModel& s, const SurfaceTriangle& t) {
  const Vec3& a = s.points[t.corners[0]];
  return (s.points[t.corners[1]] - a).cross(s.points[t.corners[2]] - a);
}

std::size_t count_exposed(const SurfaceModel& s) {
  return static_cast<std::size_t>(
      std::count_if(s.triangles.begin(), s.triangles.end(),
                    [](const SurfaceTriangle& t) { return t.exposed_by_breaking; }));
}

TEST(Boundary, OfACubeIsItsTwelveTrianglesFacingOut) {
  const SurfaceModel s = boundary(block({.name = "cube"}));
  EXPECT_EQ(s.points.size(), 8u);
  EXPECT_EQ(s.triangles.size(), 12u);
  EXPECT_THAT(s.subobject_names, ElementsAre("cube"));
  EXPECT_EQ(s.subobject_surfaces.size(), 1u);
  for (const SurfaceTriangle& t : s.triangles) {
    EXPECT_GT(normal(s, t).dot(centre(s, t) - Vec3(0.5, 0.5, 0.5)), 0.0);
    EXPECT_EQ(t.subobject, 0);
    EXPECT_FALSE(t.exposed_by_breaking);
  }
  EXPECT_EQ(test::unmatched_sides(s), 0);
  EXPECT_NEAR(test::enclosed_volume(s), 1.0, 1e-15);
}

// 2x2x2: the point in the middle, number 13 of 27, is not seen. 6 sides x 4 squares x 2.
TEST(Boundary, LeavesInnerPointsOutAndKeepsTheOrderOfTheRest) {
  const PhysicalModel m = block({.cells = {2, 2, 2}});
  const SurfaceModel s = boundary(m);
  EXPECT_EQ(s.triangles.size(), 48u);
  std::vector<PointId> expected;
  for (PointId p : ids_of(m.points))
    if (p != PointId(13)) expected.push_back(p);
  EXPECT_EQ(s.source_point, expected);
  for (std::size_t i = 0; i < s.points.size(); ++i)
    EXPECT_EQ(s.points[i], m.geometry.points[s.source_point[i]]);
}

TEST(Boundary, TrianglesNameTheirFaces) {
  const PhysicalModel m = block({.cells = {2, 2, 1}});
  const SurfaceModel s = boundary(m);
  for (const SurfaceTriangle& t : s.triangles)
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(s.source_point[t.corners[i]], m.geometry.faces[t.source].corners[i]);
}

// A bar of two: once cell 0 is gone, the square between shows, and only there.
TEST(Boundary, ExposedFacesLieOnTheFracture) {
  PhysicalModel m = block({.cells = {2, 1, 1}});
  const EdgeId first[] = {EdgeId(0)};
  break_edges(m, first);
  const SurfaceModel s = boundary(m);
  EXPECT_EQ(s.triangles.size(), 12u);
  EXPECT_EQ(count_exposed(s), 2u);
  for (const SurfaceTriangle& t : s.triangles) {
    EXPECT_EQ(t.exposed_by_breaking, centre(s, t)[0] == 1.0);
    EXPECT_EQ(m.geometry.faces[t.source].cell, CellId(1));
  }
  EXPECT_EQ(test::unmatched_sides(s), 0);
  EXPECT_NEAR(test::enclosed_volume(s), 1.0, 1e-15);
}

TEST(Boundary, NothingIsLeftOfABrokenCube) {
  PhysicalModel m = block({});
  const EdgeId first[] = {EdgeId(0)};
  break_edges(m, first);
  EXPECT_THAT(boundary(m).triangles, IsEmpty());
  EXPECT_THAT(boundary(m).points, IsEmpty());
}

TEST(Boundary, AllFacesOfTwoDimensionalObjectsAreExternal) {
  EXPECT_EQ(boundary(sheet(3, false)).triangles.size(), 18u);
  EXPECT_EQ(boundary(sheet(3, true)).triangles.size(), 18u);
  EXPECT_EQ(count_exposed(boundary(sheet(3, true))), 0u);
}

// Edge 1 of the sheet of 2x2 squares runs between the first two squares, (1,0) to (1,1): a triangle
// on either side vanishes. With square cells the whole of both squares does.
TEST(Boundary, SheetFacesVanishWithTheirEdges) {
  const EdgeId between[] = {EdgeId(1)};
  PhysicalModel faces = sheet(2, false);
  break_edges(faces, between);
  EXPECT_EQ(boundary(faces).triangles.size(), 6u);
  PhysicalModel polygons = sheet(2, true);
  break_edges(polygons, between);
  EXPECT_EQ(boundary(polygons).triangles.size(), 4u);
}

// Faces without edges (a painted decoration) have nothing to lose.
TEST(Boundary, AFaceWithoutEdgesStays) {
  GeometricModelBuilder builder;
  builder.begin_subobject("sign");
  PointId p[4];
  for (int i = 0; i < 4; ++i) p[i] = builder.add_point(Vec3(i & 1, i >> 1, 0));
  builder.edge(p[0], p[3]);
  builder.add_face({p[0], p[1], p[2]});
  PhysicalModel m = test::with_plausible_attributes(builder.finish(), "sign");
  const EdgeId only[] = {EdgeId(0)};
  break_edges(m, only);
  EXPECT_EQ(boundary(m).triangles.size(), 1u);
}

TEST(Boundary, PointsAndRopesHaveNone) {
  GeometricModelBuilder builder;
  builder.begin_subobject("rope");
  const PointId p = builder.add_point(Vec3(0, 0, 0));
  builder.edge(p, builder.add_point(Vec3(1, 0, 0)));
  const SurfaceModel s = boundary(test::with_plausible_attributes(builder.finish(), "rope"));
  EXPECT_THAT(s.points, IsEmpty());
  EXPECT_THAT(s.triangles, IsEmpty());
  EXPECT_THAT(s.subobject_names, ElementsAre("rope"));
  EXPECT_THAT(boundary(PhysicalModel()).triangles, IsEmpty());
}

// Glue adds a subobject without faces; the triangles of both parts still find their own.
TEST(Boundary, TellsSubobjectsApart) {
  const PhysicalModel seat = block({.name = "seat"});
  const PhysicalModel back = block({.origin = Vec3(1.25, 0, 0), .name = "back"});
  const SurfaceModel s = boundary(glue(seat, back, {.distance = 0.25}).model);
  EXPECT_THAT(s.subobject_names, ElementsAre("seat", "back", "glue: seat + back"));
  EXPECT_EQ(s.subobject_surfaces.size(), 3u);
  ASSERT_EQ(s.triangles.size(), 24u);
  for (const SurfaceTriangle& t : s.triangles)
    EXPECT_EQ(t.subobject, centre(s, t)[0] > 1.1 ? 1 : 0);
}

}  // namespace
}  // namespace limber
