#include "core/dynamics/memory_use.h"

#include <gtest/gtest.h>

#include "core/modeller/cubic_lattice.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

MemoryUse use_of(const PhysicalModel& model) { return memory_use(test::lattice_of({model})); }

MemoryUse operator-(const MemoryUse& a, const MemoryUse& b) {
  return {a.points - b.points, a.springs - b.springs, a.breaking - b.breaking,
          a.authored - b.authored};
}

// Of so many more points, and as many more edges.
MemoryUse use_of_rope(int points) { return use_of(test::chain({.points = points})); }

CubicLattice cube(CubicSprings springs) { return {.points = {3, 3, 3}, .springs = springs}; }

// A few links, and a word or two that are there once.
constexpr std::size_t kEnds = 64;

TEST(MemoryUse, GrowsAsTheRope) {
  const MemoryUse once = use_of_rope(201) - use_of_rope(1);
  const MemoryUse twice = use_of_rope(401) - use_of_rope(1);
  EXPECT_EQ(twice.points, 2 * once.points);
  EXPECT_NEAR(twice.springs, 2.0 * once.springs, kEnds);
  EXPECT_NEAR(twice.breaking, 2.0 * once.breaking, kEnds);
  EXPECT_EQ(twice.authored, 2 * once.authored);
  EXPECT_NEAR(twice.total(), 2.0 * once.total(), 2 * kEnds);
}

// By hand, bytes. A point cannot do without position, velocity and force (9 doubles) and mass; it
// may have as much again. A spring has two ends (8), five doubles (48 in all) and an active copy
// of these.
// As authored a point has 7 doubles and an edge two ends, five doubles and flags.
TEST(MemoryUse, OfAPointAndItsEdgeIsWhatTheirNumbersTake) {
  const MemoryUse more = use_of_rope(201) - use_of_rope(1);
  EXPECT_GE(more.points, 200u * 80);
  EXPECT_LE(more.points, 200u * 160);
  EXPECT_GE(more.springs, 200u * 2 * 48);
  EXPECT_LE(more.springs, 200u * 3 * 48);
  EXPECT_GE(more.authored, 200u * (56 + 48));
  EXPECT_LE(more.authored, 200u * (2 * 56 + 2 * 48));
  EXPECT_GE(more.total(), 200u * (80 + 96 + 104));
  EXPECT_LE(more.total(), 200u * (160 + 144 + 208 + 32));
}

// What breaking keeps of an edge without cells and faces: that it is broken, how many cells it has
// (none), and where its lists of cells and faces would begin.
TEST(MemoryUse, OfARopeHasNothingForCellsAndFaces) {
  const MemoryUse more = use_of_rope(201) - use_of_rope(1);
  EXPECT_GT(more.breaking, 0u);
  EXPECT_LE(more.breaking, 200u * 16);
}

TEST(MemoryUse, OfPointsWithoutEdgesHasNothingForSprings) {
  const MemoryUse loose = use_of(cubic_lattice(cube({})));
  EXPECT_EQ(loose.points, 27 * use_of_rope(1).points);
  EXPECT_LE(loose.springs, 27 * 4 + kEnds);  // where the list of a point's edges would begin
  EXPECT_LE(loose.breaking, kEnds);
}

// The same 27 points and 54 axial edges with 8 cells of 12 edges and 12 faces each, and without:
// each cell is linked with its edges both ways and with its faces (4 bytes a link at least).
TEST(MemoryUse, OfCellsAndFacesIsTheirLinks) {
  PhysicalModel solid = cubic_lattice(cube({.axial = 100.0}));
  PhysicalModel frame = solid;
  frame.geometry.cells = {};
  frame.geometry.faces = {};
  for (Subobject& part : frame.geometry.subobjects) part.cells = {}, part.faces = {};
  frame.cells = {};
  frame.faces = {};
  const MemoryUse with = use_of(solid), without = use_of(frame);
  EXPECT_EQ(with.points, without.points);
  EXPECT_EQ(with.springs, without.springs);
  EXPECT_GE(with.breaking - without.breaking, 8u * (12 + 12 + 12) * 4);
  EXPECT_LE(with.breaking - without.breaking, 2u * 8 * (12 + 12 + 12) * 4 + 8 * 12 * 16);
  EXPECT_GE(with.authored - without.authored, 8u * (12 + 12) * 4 + 96 * 3 * 4);
  EXPECT_GE(with.total() - without.total(), 8u * 36 * 4 + 8u * 24 * 4 + 96 * 12);
}

TEST(MemoryUse, OfTwoObjectsIsThatOfBoth) {
  const PhysicalModel rope = test::chain({.points = 100});
  const PhysicalModel solid = cubic_lattice(cube({.axial = 100.0}));
  const MemoryUse both = memory_use(test::lattice_of({rope, solid}));
  EXPECT_NEAR(both.total(), use_of(rope).total() + use_of(solid).total(), kEnds);
}

TEST(MemoryUse, OfNothingIsNearlyNothing) { EXPECT_LT(memory_use(Lattice{}).total(), kEnds); }

}  // namespace
}  // namespace limber
