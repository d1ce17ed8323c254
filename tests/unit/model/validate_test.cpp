#include "core/model/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/operators/breaking_operator.h"
#include "tests/support/blocks.h"

// Each case spoils one thing in a valid model and expects the one invariant that names it.

namespace limber {
namespace {

using test::block;
using test::sheet;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

PointId point(int i) { return PointId(std::size_t(i)); }
EdgeId edge(int i) { return EdgeId(std::size_t(i)); }
FaceId face(int i) { return FaceId(std::size_t(i)); }
CellId cell(int i) { return CellId(std::size_t(i)); }

// Two cells in a row: 12 points, 24 faces, cells 0 and 1.
PhysicalModel bar() { return block({.cells = {2, 1, 1}, .name = "bar"}); }

std::string all_text(const std::vector<Diagnostic>& found) {
  std::string text;
  for (const Diagnostic& d : found) text += d.text() + "\n";
  return text;
}

struct Violation {
  const char* name;
  std::function<void(PhysicalModel&)> spoil;
  const char* invariant;  // "G2"
  const char* where;      // "bar: edge 3"
  const char* number;     // what was found, as it stands in the message
};

void PrintTo(const Violation& v, std::ostream* out) { *out << v.name; }

class OneInvariant : public ::testing::TestWithParam<Violation> {};

TEST_P(OneInvariant, IsReportedAloneWithElementNumberAndRemedy) {
  const Violation& v = GetParam();
  PhysicalModel m = bar();
  v.spoil(m);
  const std::vector<Diagnostic> found = validate(m, 100);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().where, v.where) << all_text(found);
  EXPECT_THAT(found.front().what, HasSubstr(v.number));
  for (const Diagnostic& d : found) {
    EXPECT_THAT(d.what, StartsWith(std::string(v.invariant) + " ")) << all_text(found);
    EXPECT_FALSE(d.remedy.empty());
  }
}

const Violation kGeometry[] = {
    {"EdgeEndOutOfRange", [](auto& m) { m.geometry.edges[edge(3)].b = point(99); }, "G1",
     "bar: edge 3", "99"},
    {"EdgeEndNegative", [](auto& m) { m.geometry.edges[edge(3)].a.value = -7; }, "G1",
     "bar: edge 3", "-7"},
    {"ParallelEdge",
     [](auto& m) {
       const Edge first = m.geometry.edges[edge(0)];
       m.geometry.edges.push_back({first.b, first.a});
       m.edges.push_back(m.edges[edge(0)]);
       ++m.geometry.subobjects[0].edges.end;
     },
     "G2", "bar: edge 50", "edge 0"},
    {"LoopEdge",
     [](auto& m) {
       m.geometry.edges.push_back({point(4), point(4)});
       m.edges.push_back(m.edges[edge(0)]);
       ++m.geometry.subobjects[0].edges.end;
     },
     "G2", "bar: edge 50", "point 4"},
    {"FaceCornersRotated",
     [](auto& m) {
       auto& c = m.geometry.faces[face(2)].corners;
       c = {c[1], c[2], c[0]};
     },
     "G3", "bar: face 2", "smallest"},
    {"SheetFaceWithEqualCorners",
     [](auto& m) {
       m.geometry.faces.push_back({{point(3), point(3), point(5)}, CellId()});
       m.faces.push_back({});
       ++m.geometry.subobjects[0].faces.end;
     },
     "G3", "bar: face 24", "(3, 3, 5)"},
    {"CellListsEdgeTwice",
     [](auto& m) {
       auto& cells = m.geometry.cells;
       cells[cell(1)].edges.push_back(cells[cell(1)].edges[0]);
     },
     "G4", "bar: cell 1", "twice"},
    {"FaceThatNoCellLists",
     [](auto& m) {
       m.geometry.faces.push_back({{point(0), point(1), point(11)}, cell(1)});
       m.faces.push_back({});
       ++m.geometry.subobjects[0].faces.end;
     },
     "G4", "bar: face 24", "0 times"},
    {"EmptyCell",
     [](auto& m) {
       m.geometry.cells.push_back({});
       m.cells.push_back({});
       ++m.geometry.subobjects[0].cells.end;
     },
     "G4", "bar: cell 2", "0 edges and 0 faces"},
    {"FirstSubobjectBeginsLate", [](auto& m) { m.geometry.subobjects[0].points.begin = 2; }, "G9",
     "bar: subobject 0 (bar)", "points 2 to 12"},
    {"LastSubobjectEndsEarly", [](auto& m) { m.geometry.subobjects[0].cells.end = 1; }, "G9",
     "bar: subobject 0 (bar)", "cells end at 1"},
    {"NoSubobject",
     [](auto& m) {
       m.geometry.subobjects.clear();
       m.parts.clear();
     },
     "G9", "bar: subobjects", "end at 0"},
    {"PositionNan", [](auto& m) { m.geometry.points[point(5)][1] = kNan; }, "G10", "bar: point 5",
     "nan"},
    {"PositionInfinite", [](auto& m) { m.geometry.points[point(5)][2] = -kInfinity; }, "G10",
     "bar: point 5", "-inf"},
};

const Violation kPhysics[] = {
    {"TooFewPointAttributes", [](auto& m) { m.points.resize(11); }, "P1", "bar: point attributes",
     "11 entries for 12"},
    {"TooManyEdgeAttributes", [](auto& m) { m.edges.resize(51, m.edges[edge(0)]); }, "P1",
     "bar: edge attributes", "51 entries for 50"},
    {"NoFaceAttributes", [](auto& m) { m.faces.resize(0); }, "P1", "bar: face attributes",
     "0 entries for 24"},
    {"TooFewCellAttributes", [](auto& m) { m.cells.resize(1); }, "P1", "bar: cell attributes",
     "1 entries for 2"},
    {"MassNegative", [](auto& m) { m.points[point(7)].mass = -1; }, "P2", "bar: point 7", "-1 kg"},
    {"MassZero", [](auto& m) { m.points[point(7)].mass = 0; }, "P2", "bar: point 7", "0 kg"},
    {"MassInfinite", [](auto& m) { m.points[point(7)].mass = kInfinity; }, "P2", "bar: point 7",
     "inf kg"},
    {"VelocityNan", [](auto& m) { m.points[point(7)].velocity[0] = kNan; }, "P3", "bar: point 7",
     "nan"},
    {"StiffnessNegative", [](auto& m) { m.edges[edge(9)].stiffness = -2.5; }, "P4", "bar: edge 9",
     "stiffness is -2.5"},
    {"StiffnessInfinite", [](auto& m) { m.edges[edge(9)].stiffness = kInfinity; }, "P4",
     "bar: edge 9", "inf"},
    {"DampingNan", [](auto& m) { m.edges[edge(9)].damping = kNan; }, "P4", "bar: edge 9",
     "damping is nan"},
    {"RestLengthZero", [](auto& m) { m.edges[edge(9)].rest_length = 0; }, "P5", "bar: edge 9",
     "0 m"},
    {"RestLengthInfinite", [](auto& m) { m.edges[edge(9)].rest_length = kInfinity; }, "P5",
     "bar: edge 9", "inf m"},
    {"ThresholdZero", [](auto& m) { m.edges[edge(9)].break_threshold = 0; }, "P6", "bar: edge 9",
     "0 m"},
    {"ThresholdNan", [](auto& m) { m.edges[edge(9)].break_threshold = kNan; }, "P6", "bar: edge 9",
     "nan m"},
    {"FrictionNegative", [](auto& m) { m.object.friction = -0.1; }, "P9", "bar: object",
     "friction is -0.1"},
    {"RestitutionAboveOne", [](auto& m) { m.object.restitution = 1.5; }, "P9", "bar: object",
     "restitution is 1.5"},
    {"InternalDampingNan", [](auto& m) { m.object.internal_damping = kNan; }, "P9", "bar: object",
     "internal damping is nan"},
    {"SofteningBelowOne", [](auto& m) { m.object.softening = 0.5; }, "P9", "bar: object",
     "softening is 0.5"},
    {"CrushThresholdZero", [](auto& m) { m.edges[edge(9)].crush_threshold = 0; }, "P6",
     "bar: edge 9", "crush threshold is 0 m"},
    {"ParticleRadiusNegative", [](auto& m) { m.object.particle_radius = -0.01; }, "P9",
     "bar: object", "-0.01 m"},
    {"ContactShareAboveItsRange", [](auto& m) { m.object.contact_share = 0.5; }, "P9",
     "bar: object", "contact share is 0.5"},
    {"NoPart", [](auto& m) { m.parts.clear(); }, "P10", "bar: parts", "0 entries for 1"},
    {"ColourAboveOne", [](auto& m) { m.parts[0].surface.colour[2] = 255; }, "P10", "bar: part 0",
     "255"},
    {"TransparencyNan", [](auto& m) { m.parts[0].surface.transparency = kNan; }, "P10",
     "bar: part 0", "nan"},
    {"SpecularityNegative", [](auto& m) { m.parts[0].surface.specularity = -1; }, "P10",
     "bar: part 0", "-1"},
    {"StrandRadiusNegative", [](auto& m) { m.parts[0].surface.strand_radius = -0.1; }, "P10",
     "bar: part 0", "-0.1 m"},
    {"RefractionBelowOne", [](auto& m) { m.parts[0].surface.index_of_refraction = 0.9; }, "P10",
     "bar: part 0", "refraction is 0.9"},
    {"RefractionInfinite", [](auto& m) { m.parts[0].surface.index_of_refraction = kInfinity; },
     "P10", "bar: part 0", "refraction is inf"},
    {"ValueNan", [](auto& m) { m.parts[0].values["temperature"] = kNan; }, "P12", "bar: part 0",
     "'temperature' is nan"},
    {"DragNegative", [](auto& m) { m.faces[face(4)].tangential_drag = -3; }, "P11", "bar: face 4",
     "-3"},
    {"DragInfinite", [](auto& m) { m.faces[face(4)].normal_drag = kInfinity; }, "P11",
     "bar: face 4", "inf"},
};

std::string name_of(const ::testing::TestParamInfo<Violation>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Geometry, OneInvariant, ::testing::ValuesIn(kGeometry), name_of);
INSTANTIATE_TEST_SUITE_P(Physics, OneInvariant, ::testing::ValuesIn(kPhysics), name_of);

void expect_only(const std::vector<Diagnostic>& found, const char* invariant, const char* where) {
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().where, where) << all_text(found);
  for (const Diagnostic& d : found)
    EXPECT_THAT(d.what, StartsWith(std::string(invariant) + " ")) << all_text(found);
}

TEST(Validate, FindsNothingInSoundModels) {
  EXPECT_EQ(all_text(validate(bar())), "");
  EXPECT_EQ(all_text(validate(bar().geometry, "bar")), "");
  EXPECT_EQ(all_text(validate(block({.cells = {3, 2, 2}, .edges = test::kAxial}))), "");
  EXPECT_EQ(all_text(validate(sheet(3, false))), "");
  EXPECT_EQ(all_text(validate(sheet(3, true))), "");
  EXPECT_EQ(all_text(validate(sheet(3, true).geometry, "sheet")), "");
  EXPECT_EQ(all_text(validate(PhysicalModel())), "");
}

TEST(Validate, FindsNothingAfterBreaking) {
  PhysicalModel m = block({.cells = {3, 3, 3}});
  const EdgeId edges[] = {edge(0), edge(200)};
  ASSERT_FALSE(break_edges(m, edges).invalid_cells.empty());
  EXPECT_EQ(all_text(validate(m)), "");
}

TEST(Validate, FaceCellOutOfRangeIsG1) {
  PhysicalModel m = sheet(1, false);
  m.geometry.faces[face(1)].cell = cell(5);
  expect_only(validate(m), "G1", "sheet: face 1");
}

TEST(Validate, CornerOutOfRangeIsG1) {
  PhysicalModel m = sheet(1, false);
  m.geometry.faces[face(1)].corners[2] = point(77);
  expect_only(validate(m), "G1", "sheet: face 1");
}

TEST(Validate, CellListsOutOfRangeAreG1) {
  PhysicalModel m = bar();
  m.geometry.cells[cell(0)].edges.push_back(edge(1000));
  m.geometry.cells[cell(1)].faces.push_back(face(-1));
  const auto found = validate(m);
  expect_only(found, "G1", "bar: cell 0");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].where, "bar: cell 1");
}

TEST(Validate, AFaceListedByTwoCellsIsG4) {
  PhysicalModel m = sheet(2, true);
  auto& cells = m.geometry.cells;
  cells[cell(0)].faces.push_back(cells[cell(1)].faces[0]);
  const auto found = validate(m);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].where, "sheet: cell 0");
  EXPECT_THAT(found[0].what, StartsWith("G4 lists face 2, which belongs to cell 1"));
}

// A square 2-D cell that no longer lists the edge along one of its sides.
TEST(Validate, OutlineWithoutAnEdgeIsG6) {
  PhysicalModel m = sheet(1, true);
  m.geometry.cells[cell(0)].edges.erase(m.geometry.cells[cell(0)].edges.begin());
  expect_only(validate(m), "G6", "sheet: cell 0");
}

// Corner 0 of the first cell keeps its faces but loses every edge that ends in it.
TEST(Validate, CornerWithoutAnEdgeIsG6) {
  PhysicalModel m = bar();
  std::erase_if(m.geometry.cells[cell(0)].edges,
                [&](EdgeId e) { return m.geometry.edges[e].a == point(0); });
  const auto found = validate(m);
  expect_only(found, "G6", "bar: cell 0");
  EXPECT_THAT(found[0].what, HasSubstr("point 0 "));
}

TEST(Validate, AFlippedFaceIsG7) {
  PhysicalModel m = bar();
  auto& corners = m.geometry.faces[face(0)].corners;
  corners = reversed(corners);
  expect_only(validate(m), "G7", "bar: cell 0");
}

// Removing a triangle of a cube leaves a hole; its outline is a loop, but not a polygon's.
TEST(Validate, AHoleInACellIsG7) {
  PhysicalModel m = block({.name = "box"});
  m.geometry.cells[cell(0)].faces.pop_back();
  m.geometry.faces.resize(11);
  m.faces.resize(11);
  m.geometry.subobjects[0].faces.end = 11;
  expect_only(validate(m), "G7", "box: cell 0");
}

// All faces turned: closed, consistent, and inside out. Found where geometry is authored; a model
// from the simulator may be deformed that far.
TEST(Validate, NegativeVolumeIsG8AtAuthoringOnly) {
  PhysicalModel m = block({.name = "box"});
  for (Face& f : m.geometry.faces) f.corners = reversed(f.corners);
  const auto found = validate(m.geometry, "box");
  expect_only(found, "G8", "box: cell 0");
  EXPECT_THAT(found[0].what, HasSubstr("-1 m^3"));
  EXPECT_TRUE(validate(m).empty());
}

TEST(Validate, FlatCellIsG8) {
  GeometricModel g = test::block_geometry({});
  for (Vec3& x : g.points) x[1] = 0.0;
  expect_only(validate(g, "flat"), "G8", "flat: cell 0");
}

// Two 2-D cells on the same triangle, both looking up.
TEST(Validate, EqualFacesOfTwoCellsAreG11) {
  GeometricModelBuilder builder;
  builder.begin_subobject("double");
  PointId p[3];
  for (int i = 0; i < 3; ++i) p[i] = builder.add_point(Vec3(i == 1, i == 2, 0));
  const std::array<PointId, 2> edges[] = {{p[0], p[1]}, {p[1], p[2]}, {p[2], p[0]}};
  const std::array<PointId, 3> faces[] = {{p[0], p[1], p[2]}};
  builder.add_cell(edges, faces);
  builder.add_cell(edges, faces);
  const PhysicalModel m = test::with_plausible_attributes(builder.finish(), "double");
  expect_only(validate(m), "G11", "double: face 1");
}

TEST(Validate, BrokenEdgeInAValidCellIsP7) {
  PhysicalModel m = bar();
  m.edges[edge(0)].broken = true;
  const auto found = validate(m);
  expect_only(found, "P7", "bar: cell 0");
  EXPECT_THAT(found[0].what, HasSubstr("valid with 1 broken"));
}

// Every edge of the middle cell of 3x3x3 is shared with a valid cell, so nothing else is amiss.
TEST(Validate, InvalidCellWithoutBrokenEdgeIsP7) {
  PhysicalModel m = block({.cells = {3, 3, 3}, .edges = test::kAxial});
  m.cells[cell(13)].valid = false;
  const auto found = validate(m, 100);
  expect_only(found, "P7", "block: cell 13");
  EXPECT_THAT(found[0].what, HasSubstr("invalid with 0 broken"));
}

// One cube, 28 edges, one of them broken and the cell invalid: the other 27 should be broken too.
TEST(Validate, WholeEdgeOfOnlyInvalidCellsIsP8) {
  PhysicalModel m = block({.name = "box"});
  m.edges[edge(0)].broken = true;
  m.cells[cell(0)].valid = false;
  const auto found = validate(m, 100);
  expect_only(found, "P8", "box: edge 1");
  EXPECT_EQ(found.size(), 27u);
}

TEST(Validate, ListsAtMostAsManyAsAsked) {
  PhysicalModel m = bar();
  for (PointAttributes& p : m.points) p.mass = 0.0;
  EXPECT_EQ(validate(m, 5).size(), 5u);
  EXPECT_EQ(validate(m).size(), 12u);
  EXPECT_TRUE(validate(m, 0).empty());
}

TEST(Validate, RequireValidThrowsTheFirst) {
  PhysicalModel m = bar();
  EXPECT_NO_THROW(require_valid(m));
  m.points[point(3)].mass = -2.0;
  try {
    require_valid(m);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "bar: point 3: P2 mass is -2 kg; give it a finite mass above 0");
  }
}

}  // namespace
}  // namespace limber
