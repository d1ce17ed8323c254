#include "core/operators/glue_notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/operators/gluing_operator.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

using ::testing::HasSubstr;

PhysicalModel block_at(std::array<int, 3> cells, double spacing, const Vec3& origin,
                       const char* name) {
  return test::block(
      {.cells = cells, .spacing = spacing, .origin = origin, .edges = test::kAxial, .name = name});
}

GlueSeam seam_of(const PhysicalModel& a, const PhysicalModel& b, double distance) {
  return glue_seam(a, b, pairs_within(a.geometry.points, b.geometry.points, distance));
}

// A cube of 3^3 points, 1 m apart, under one of 5^3 points, 0.5 m apart, with a gap of 0.5 m: at
// 0.75 m each lower point meets the one above it and that one's neighbours, 0.707 m away.
TEST(GlueSeam, IsCountedAndMeasured) {
  const PhysicalModel below = block_at({2, 2, 2}, 1.0, Vec3::Zero(), "below");
  const PhysicalModel above = block_at({4, 4, 4}, 0.5, {0, 2.5, 0}, "above");
  const GlueSeam seam = seam_of(below, above, 0.75);
  EXPECT_EQ(seam.bonds, 9u + 24u);  // 2 neighbours at 4 corners, 3 at 4 sides, 4 in the middle
  EXPECT_EQ(seam.a.points, 9u);
  EXPECT_EQ(seam.b.points, 9u + 12u);  // a neighbour between two counts once
  EXPECT_EQ(seam.a.most_bonds, 5u);
  EXPECT_EQ(below.geometry.points[seam.a.most_bonded], Vec3(1, 2, 1));
  EXPECT_EQ(seam.b.most_bonds, 2u);
  EXPECT_DOUBLE_EQ(seam.a.spacing_m, 1.0);
  EXPECT_DOUBLE_EQ(seam.b.spacing_m, 0.5);
  EXPECT_DOUBLE_EQ(seam.shortest_m, 0.5);
  EXPECT_DOUBLE_EQ(seam.longest_m, std::sqrt(0.5));
}

TEST(GlueNotes, SaySpacingsAndCrowdingOfACoarseBlockOnAFineOne) {
  const PhysicalModel below = block_at({2, 2, 2}, 1.0, Vec3::Zero(), "below");
  const PhysicalModel above = block_at({4, 4, 4}, 0.5, {0, 2.5, 0}, "above");
  const auto notes = glue_notes(below, above, seam_of(below, above, 0.75));
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_THAT(notes[0].what, HasSubstr("1 m apart on one side, 0.5 m on the other"));
  EXPECT_THAT(notes[1].what, HasSubstr("of below has 5 of 33 bonds; 9 points meet 21"));
}

// Diagonals make a seam that carries shear: nine bonds a point are as they should be.
TEST(GlueNotes, HaveNothingToSayOfEqualGridsWithDiagonals) {
  const PhysicalModel below = block_at({4, 2, 4}, 1.0, Vec3::Zero(), "below");
  const PhysicalModel above = block_at({4, 2, 4}, 1.0, {0, 3, 0}, "above");
  const GlueSeam seam = seam_of(below, above, 1.74);  // the next are 2 m away
  EXPECT_EQ(seam.a.most_bonds, 9u);
  EXPECT_TRUE(glue_notes(below, above, seam).empty());
}

TEST(GlueNotes, SayWhenBondsDifferInLength) {
  const PhysicalModel below = block_at({4, 2, 4}, 1.0, Vec3::Zero(), "below");
  const PhysicalModel above = block_at({4, 2, 4}, 1.0, {0, 2.25, 0}, "above");
  const auto notes = glue_notes(below, above, seam_of(below, above, 1.04));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].what, HasSubstr("0.25 m to 1.03077641 m (median 1.03077641 m)"));
}

TEST(GlueNotes, SayWhatTheSecondModelLoses) {
  const PhysicalModel below = block_at({2, 2, 2}, 1.0, Vec3::Zero(), "below");
  PhysicalModel above = block_at({2, 2, 2}, 1.0, {0, 3, 0}, "above");
  above.object.softening = 100.0;
  const GlueResult glued = glue(below, above, {.distance = 1.0});
  ASSERT_EQ(glued.notes.size(), 1u);
  EXPECT_EQ(glued.notes[0].what, "softening S becomes 1, that of below; above had 100");
}

}  // namespace
}  // namespace limber
