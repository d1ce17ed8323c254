#include "core/operators/gluing_operator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/operators/breaking_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/gluing_cases.h"
#include "tests/support/measure.h"

namespace limber {
namespace {

using test::block;
using test::momentum;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

PhysicalModel block_at(std::array<int, 3> cells, double spacing, const Vec3& origin,
                       const char* name) {
  return block(
      {.cells = cells, .spacing = spacing, .origin = origin, .edges = test::kAxial, .name = name});
}

std::vector<std::string> names(const PhysicalModel& m) {
  std::vector<std::string> found;
  for (const Subobject& s : m.geometry.subobjects) found.push_back(s.name);
  return found;
}

// Two blocks of 3x3x3 points, 1 m apart, one above the other with a gap of 0.5 m. Straight across:
// 9 bonds; from 1.118 m = sqrt(0.25 + 1) also to each neighbour, 12 pairs of neighbours on 3x3, two
// ways each: 24 more; from 1.5 m = sqrt(0.25 + 2) to the neighbours across the diagonal, 4 squares
// with 4 directed pairs (16), and to the second layers, straight (9 + 9).
TEST(Glue, CountsBondsAcrossAGap) {
  const PhysicalModel below = block_at({2, 2, 2}, 1.0, Vec3::Zero(), "below");
  const PhysicalModel above = block_at({2, 2, 2}, 1.0, Vec3(0, 2.5, 0), "above");
  EXPECT_EQ(glue(below, above, {.distance = 0.5}).bonds, 9u);
  EXPECT_EQ(glue(below, above, {.distance = 1.11}).bonds, 9u);
  EXPECT_EQ(glue(below, above, {.distance = 1.12}).bonds, 33u);
  EXPECT_EQ(glue(below, above, {.distance = 1.49}).bonds, 33u);
  EXPECT_EQ(glue(below, above, {.distance = 1.51}).bonds, 33u + 16u + 18u);
}

TEST(Glue, AgreesWithTheReferenceCounts) {
  const auto cells = [](std::array<int, 3> n) {
    return std::array<int, 3>{n[0] - 1, n[1] - 1, n[2] - 1};
  };
  for (const test::GluingCase& c : test::kGluingCases) {
    const PhysicalModel a = block_at(cells(c.points_a), c.spacing_a, Vec3::Zero(), "a");
    const PhysicalModel b = block_at(cells(c.points_b), c.spacing_b, c.origin_b, "b");
    EXPECT_EQ(glue(a, b, {.distance = c.distance}).bonds, c.at_most) << "distance " << c.distance;
  }
}

// In doubles 1.1 - 1.0 is 0.10000000000000009: rounding must not undo what was authored.
TEST(Glue, JoinsAcrossAGapThatRoundingMadeLonger) {
  const PhysicalModel a = block_at({10, 1, 1}, 0.1, Vec3::Zero(), "a");
  const PhysicalModel b = block_at({1, 1, 1}, 0.1, Vec3(1.1, 0, 0), "b");
  ASSERT_GT(b.geometry.points[PointId(0)][0] - a.geometry.points[PointId(10)][0], 0.1);
  EXPECT_EQ(glue(a, b, {.distance = 0.1}).bonds, 4u);
}

std::set<PointId> ends_in_first(const GlueResult& r) {
  std::set<PointId> ends;
  for (std::size_t e = r.model.edges.size() - r.bonds; e < r.model.edges.size(); ++e)
    ends.insert(r.model.geometry.edges[EdgeId(e)].a);
  return ends;
}

// Figure 4, the good example: equal spacing, every bond is as long as the gap and has its own ends.
TEST(Glue, Figure4EqualSpacingBondsPointToPoint) {
  const PhysicalModel below = block_at({2, 1, 2}, 1.0, Vec3::Zero(), "below");
  const PhysicalModel above = block_at({2, 1, 2}, 1.0, Vec3(0, 1.5, 0), "above");
  const GlueResult r = glue(below, above, {.distance = 0.6});
  EXPECT_EQ(r.bonds, 9u);
  EXPECT_EQ(ends_in_first(r).size(), 9u);
  for (std::size_t e = r.model.edges.size() - 9; e < r.model.edges.size(); ++e)
    EXPECT_DOUBLE_EQ(r.model.edges[EdgeId(e)].rest_length, 0.5);
  EXPECT_TRUE(r.notes.empty());
}

// Figure 4, the bad example: all 9 lower points of a fine block hang on one point of a coarse one.
// The furthest is sqrt(0.5^2 + 0.2^2 + 0.2^2) = 0.574 m away, the next layer 0.6 m.
TEST(Glue, Figure4FineOnCoarseHangsOnOnePoint) {
  const PhysicalModel below = block_at({1, 1, 1}, 4.0, Vec3::Zero(), "below");
  const PhysicalModel above = block_at({2, 1, 2}, 0.1, Vec3(0, 4.5, 0), "above");
  const GlueResult r = glue(below, above, {.distance = 0.58});
  EXPECT_EQ(r.bonds, 9u);
  EXPECT_EQ(ends_in_first(r), std::set<PointId>{PointId(2)});  // (0, 4, 0)
  // Of nine distances sqrt(0.5^2 + x^2 + z^2), x and z being 0, 0.1 and 0.2, the fifth is
  // sqrt(0.29).
  ASSERT_EQ(r.notes.size(), 2u);
  EXPECT_EQ(r.notes[0].where, "glue: below + above");
  EXPECT_EQ(r.notes[0].what,
            "the spacings do not match: points are 4 m apart on one side, 0.1 m on the other; 1 "
            "points meet 9 over bonds of 0.538516481 m (median)");
  EXPECT_EQ(r.notes[1].what,
            "many points meet one: point 2 of below has 9 of 9 bonds; 1 points meet 9");
}

// The same, bonded one to one: the nearest of the nine alone.
TEST(Glue, OneToOneBondsEachPointOnce) {
  const PhysicalModel below = block_at({1, 1, 1}, 4.0, Vec3::Zero(), "below");
  const PhysicalModel above = block_at({2, 1, 2}, 0.1, Vec3(0, 4.5, 0), "above");
  const GlueResult r = glue(below, above, {.distance = 0.58, .one_to_one = true});
  EXPECT_EQ(r.bonds, 1u);
  EXPECT_DOUBLE_EQ(r.model.edges[EdgeId(r.model.edges.size() - 1)].rest_length, 0.5);
  ASSERT_EQ(r.notes.size(), 1u);  // nothing is crowded, but the spacings are what they are
  EXPECT_THAT(r.notes[0].what, HasSubstr("spacings do not match"));
}

TEST(Glue, BondsHaveTheAttributesAsked) {
  const PhysicalModel a = block_at({1, 1, 1}, 1.0, Vec3::Zero(), "a");
  const PhysicalModel b = block_at({1, 1, 1}, 1.0, Vec3(1.25, 0, 0), "b");
  const GlueBond bond{
      .distance = 0.3, .stiffness = 70, .damping = 3, .break_strain = 0.2, .crush_strain = 0.4};
  const PhysicalModel m = glue(a, b, bond).model;
  const EdgeAttributes& last = m.edges[EdgeId(m.edges.size() - 1)];
  EXPECT_EQ(last.stiffness, 70);
  EXPECT_EQ(last.damping, 3);
  EXPECT_EQ(last.rest_length, 0.25);
  EXPECT_EQ(last.break_threshold, 0.05);
  EXPECT_EQ(last.crush_threshold, 0.1);
  EXPECT_FALSE(last.broken);
  const PhysicalModel strong = glue(a, b, {.distance = 0.3}).model;
  EXPECT_EQ(strong.edges[EdgeId(strong.edges.size() - 1)].break_threshold, kUnbreakable);
}

// Second operand shifted by the size of the first, everything else as it was.
TEST(Glue, KeepsBothModelsAsTheyAre) {
  PhysicalModel a = block_at({2, 1, 1}, 1.0, Vec3::Zero(), "a");
  PhysicalModel b = block_at({1, 1, 1}, 1.0, Vec3(2.25, 0, 0), "b");
  a.object.friction = 0.9;
  b.parts[0].surface.specularity = 0.7;
  b.parts[0].values["temperature"] = 350.0;
  b.edges[EdgeId(3)].crush_threshold = 0.02;
  for (PointId p : ids_of(b.points)) b.points[p] = {1.0 + p.value, Vec3(p.value, 0.1, -3)};
  b.points[PointId(5)].pinned = true;
  const EdgeId first[] = {EdgeId(0)};
  break_edges(a, first);
  const PhysicalModel m = glue(a, b, {.distance = 0.25}).model;

  EXPECT_EQ(m.name, "a + b");
  EXPECT_EQ(m.object.friction, 0.9);
  EXPECT_EQ(m.parts[1].surface.specularity, 0.7);
  EXPECT_EQ(m.parts[1].values.at("temperature"), 350.0);
  EXPECT_TRUE(m.parts[0].values.empty());
  EXPECT_EQ(m.edges[EdgeId(a.edges.size() + 3)].crush_threshold, 0.02);
  EXPECT_FALSE(m.cells[CellId(0)].valid);
  for (PointId p : ids_of(b.points)) {
    const PointId moved(p.index() + a.points.size());
    EXPECT_EQ(m.points[moved].mass, b.points[p].mass);
    EXPECT_EQ(m.points[moved].velocity, b.points[p].velocity);
    EXPECT_EQ(m.points[moved].pinned, b.points[p].pinned);
    EXPECT_EQ(m.geometry.points[moved], b.geometry.points[p]);
  }
  EXPECT_EQ(cell_volume(m.geometry, CellId(2)), cell_volume(b.geometry, CellId(0)));
  EXPECT_TRUE(validate(m).empty());
}

TEST(Glue, SubobjectRangesFollowEachOther) {
  const PhysicalModel a = block_at({2, 1, 1}, 1.0, Vec3::Zero(), "a");
  const PhysicalModel b = block_at({1, 1, 1}, 1.0, Vec3(2.25, 0, 0), "b");
  const PhysicalModel m = glue(a, b, {.distance = 0.25}).model;
  ASSERT_THAT(names(m), ElementsAre("a", "b", "glue: a + b"));
  const auto& s = m.geometry.subobjects;
  EXPECT_EQ(s[1].points, (IdRange<PointId>{12, 20}));
  EXPECT_EQ(s[1].edges, (IdRange<EdgeId>{20, 32}));
  EXPECT_EQ(s[1].faces, (IdRange<FaceId>{24, 36}));
  EXPECT_EQ(s[1].cells, (IdRange<CellId>{2, 3}));
  EXPECT_EQ(s[2].points, (IdRange<PointId>{20, 20}));
  EXPECT_EQ(s[2].edges, (IdRange<EdgeId>{32, 36}));
  EXPECT_EQ(s[2].faces, (IdRange<FaceId>{36, 36}));
  EXPECT_EQ(s[2].cells, (IdRange<CellId>{3, 3}));
  EXPECT_EQ(m.parts.size(), 3u);
}

// Gluing makes nothing and moves nothing: mass and momentum are the same to the last bit as those
// of the two models behind each other.
TEST(Glue, ConservesMassAndMomentumExactly) {
  PhysicalModel a = block_at({1, 1, 1}, 1.0, Vec3::Zero(), "a");
  PhysicalModel b = block_at({1, 1, 1}, 1.0, Vec3(1.25, 0, 0), "b");
  set_in_motion(a, Vec3(1, 2, 3), Vec3(4, 5, 6));
  set_in_motion(b, Vec3(-8, 1, 0), Vec3(0, 0, 2));
  const PhysicalModel m = glue(a, b, {.distance = 0.25}).model;
  PhysicalModel both = a;
  both.points.append(b.points);
  EXPECT_EQ(momentum(m), momentum(both));
  EXPECT_LT((momentum(m) - momentum(a) - momentum(b)).norm(), 1e-13);
  double mass = 0.0;
  for (const PointAttributes& p : m.points) mass += p.mass;
  EXPECT_EQ(mass, 16.0);
}

// The paper's teapot: body and spout, then the handle on the result.
TEST(Glue, ResultCanBeGluedAgain) {
  const PhysicalModel body = block_at({2, 2, 2}, 1.0, Vec3::Zero(), "body");
  const PhysicalModel spout = block_at({1, 1, 1}, 1.0, Vec3(2.25, 0, 0), "spout");
  const PhysicalModel handle = block_at({1, 1, 1}, 1.0, Vec3(-1.25, 0, 0), "handle");
  const GlueBond bond{.distance = 0.25, .stiffness = 10};
  const GlueResult teapot = glue(glue(body, spout, bond).model, handle, bond);
  EXPECT_EQ(teapot.bonds, 4u);
  EXPECT_THAT(names(teapot.model), ElementsAre("body", "spout", "glue: body + spout", "handle",
                                               "glue: body + spout + handle"));
  EXPECT_EQ(teapot.model.geometry.subobjects[2].edges.size(), 4u);
  EXPECT_TRUE(validate(teapot.model).empty());
}

TEST(Glue, ABondBreaksAloneAndLeavesAllCells) {
  const PhysicalModel a = block_at({1, 1, 1}, 1.0, Vec3::Zero(), "a");
  const PhysicalModel b = block_at({1, 1, 1}, 1.0, Vec3(1.25, 0, 0), "b");
  PhysicalModel m = glue(a, b, {.distance = 0.25}).model;
  const EdgeId last[] = {EdgeId(m.edges.size() - 1)};
  const BreakingResult result = break_edges(m, last);
  EXPECT_THAT(result.broken_edges, ElementsAre(last[0].value));
  EXPECT_TRUE(result.invalid_cells.empty());
}

Diagnostic refusal(const PhysicalModel& a, const PhysicalModel& b, const GlueBond& bond) {
  try {
    glue(a, b, bond);
  } catch (const InputError& error) {
    return error.diagnostic;
  }
  ADD_FAILURE() << "no error";
  return {};
}

// Point 1 of the cube is (1, 0, 0), point 0 of the other (3, 0, 0).
TEST(Glue, TooFarNamesTheNearestPair) {
  const PhysicalModel a = block_at({1, 1, 1}, 1.0, Vec3::Zero(), "a");
  const PhysicalModel b = block_at({1, 1, 1}, 1.0, Vec3(3, 0, 0), "b");
  const Diagnostic d = refusal(a, b, {.distance = 0.5});
  EXPECT_EQ(d.where, "a: point 1");
  EXPECT_THAT(d.what, HasSubstr("nearest to b, 2 m from its point 0"));
  EXPECT_THAT(d.what, HasSubstr("0.5 m"));
}

TEST(Glue, CoincidentPointsAreNamed) {
  const PhysicalModel a = block_at({1, 1, 1}, 1.0, Vec3::Zero(), "a");
  const PhysicalModel b = block_at({1, 1, 1}, 1.0, Vec3(1, 0, 0), "b");
  const Diagnostic d = refusal(a, b, {.distance = 0.5});
  EXPECT_EQ(d.where, "a: point 1");
  EXPECT_THAT(d.what, HasSubstr("coincides with point 0 of b"));
}

TEST(Glue, BadBondsAreRefused) {
  const PhysicalModel a = block_at({1, 1, 1}, 1.0, Vec3::Zero(), "a");
  const PhysicalModel b = block_at({1, 1, 1}, 1.0, Vec3(1.25, 0, 0), "b");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(a, b, {.distance = 0.0}).what, HasSubstr("distance (m) is 0"));
  EXPECT_THAT(refusal(a, b, {.distance = nan}).what, HasSubstr("distance (m) is nan"));
  EXPECT_THAT(refusal(a, b, {.distance = 0.5, .stiffness = -1}).what, HasSubstr("is -1"));
  EXPECT_THAT(refusal(a, b, {.distance = 0.5, .damping = nan}).what, HasSubstr("damping"));
  EXPECT_THAT(refusal(a, b, {.distance = 0.5, .break_strain = 0}).what, HasSubstr("strain is 0"));
  EXPECT_THAT(refusal(a, b, {.distance = 0.5, .crush_strain = 0}).what,
              HasSubstr("crush strain is 0"));
}

TEST(Glue, BadModelsAreRefused) {
  const PhysicalModel a = block_at({1, 1, 1}, 1.0, Vec3::Zero(), "a");
  PhysicalModel b = block_at({1, 1, 1}, 1.0, Vec3(1.25, 0, 0), "b");
  b.geometry.points[PointId(4)][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(a, b, {.distance = 0.5}).where, "b: point 4");
  EXPECT_EQ(refusal(a, PhysicalModel(), {.distance = 0.5}).what, "has no points to glue");
}

}  // namespace
}  // namespace limber
