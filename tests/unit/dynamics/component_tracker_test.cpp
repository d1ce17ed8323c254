#include "core/dynamics/component_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/blocks.h"
#include "tests/support/lattices.h"
#include "tests/support/partition.h"

namespace limber {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Split = ComponentTracker::Split;

struct Tracked {
  Lattice lattice;
  ComponentTracker tracker;

  explicit Tracked(std::vector<PhysicalModel> models)
      : lattice(test::lattice_of(std::move(models))) {
    tracker.reset(lattice);
  }

  // Compares with the union-find after every call.
  std::vector<Split> break_all(const std::vector<std::int32_t>& edges) {
    const BreakingResult result = break_edges(lattice.topology, lattice.breaking, edges);
    const std::vector<Split> splits = tracker.edges_broken(lattice, result.broken_edges);
    EXPECT_EQ(test::smallest_in_piece(tracker.components()),
              test::smallest_in_piece(components(lattice)));
    EXPECT_EQ(tracker.sizes(), test::sizes_of(tracker.components()));
    return splits;
  }
};

TEST(ComponentTracker, StartsFromComponents) {
  const Tracked t({test::chain({.points = 2}), test::chain({.points = 3})});
  EXPECT_EQ(t.tracker.components().label, components(t.lattice).label);
  EXPECT_THAT(t.tracker.sizes(), ElementsAre(2, 3));
}

TEST(ComponentTracker, TheSmallerPartOfARopeComesOff) {
  Tracked t({test::chain({.points = 6})});
  EXPECT_THAT(t.break_all({1}), ElementsAre(Split{0, 1}));
  EXPECT_THAT(t.tracker.components().label, ElementsAre(1, 1, 0, 0, 0, 0));
  EXPECT_THAT(t.break_all({4}), ElementsAre(Split{0, 2}));
  EXPECT_THAT(t.tracker.components().label, ElementsAre(1, 1, 0, 0, 0, 2));
  EXPECT_THAT(t.tracker.sizes(), ElementsAre(3, 2, 1));
}

TEST(ComponentTracker, OfEqualPartsTheOneAtTheLargerPointComesOff) {
  Tracked t({test::chain({.points = 4})});
  EXPECT_THAT(t.break_all({1}), ElementsAre(Split{0, 1}));
  EXPECT_THAT(t.tracker.components().label, ElementsAre(0, 0, 1, 1));
}

TEST(ComponentTracker, ARopeFallsIntoItsPointsAtOnce) {
  Tracked t({test::chain({.points = 4})});
  EXPECT_EQ(t.break_all({2, 0, 1}).size(), 3u);
  EXPECT_EQ(t.tracker.components().count, 4);
  EXPECT_THAT(t.tracker.sizes(), ElementsAre(1, 1, 1, 1));
}

// The point in the middle is the smaller part of either break; once it is off, nothing must hide
// that the two halves lost each other too.
TEST(ComponentTracker, TwoBreaksAroundOnePointMakeThreePieces) {
  Tracked t({test::chain({.points = 9})});
  EXPECT_EQ(t.break_all({3, 4}).size(), 2u);
  EXPECT_EQ(t.tracker.components().count, 3);
}

TEST(ComponentTracker, NothingComesOffWhereThereIsAWayAround) {
  const test::BlockShape shape{.cells = {4, 4, 4}};
  const PhysicalModel cube = test::block(shape);
  Tracked t({cube, test::sheet(3, false)});
  EXPECT_THAT(t.break_all({test::block_edge(cube, shape, {2, 2, 1}, {2, 2, 2}).value}), IsEmpty());
  EXPECT_THAT(t.break_all({t.lattice.objects[1].edges.begin + 5}), IsEmpty());
  EXPECT_EQ(t.tracker.components().count, 2);
}

// A cell takes all of its edges with it: eight points without an edge.
TEST(ComponentTracker, ABrokenCubeLeavesEightPoints) {
  Tracked t({test::block({})});
  EXPECT_EQ(t.break_all({0}).size(), 7u);
  EXPECT_EQ(t.tracker.components().count, 8);
}

// Every edge that crosses the middle of a bar of axial edges.
TEST(ComponentTracker, ABarFallsInTwo) {
  const test::BlockShape shape{.cells = {5, 1, 1}, .edges = test::kAxial};
  const PhysicalModel bar = test::block(shape);
  Tracked t({bar});
  const EdgeId edge = test::block_edge(bar, shape, {2, 0, 0}, {3, 0, 0});
  EXPECT_THAT(t.break_all({edge.value}), ElementsAre(Split{0, 1}));
  EXPECT_THAT(t.tracker.sizes(), ElementsAre(12, 12));
}

TEST(ComponentTracker, EdgesOfPointsThatAreNotDynamicDoNotCount) {
  Tracked t({test::chain({.points = 3}), test::chain({.points = 3})});
  for (int p = 0; p < 3; ++p) t.lattice.role[p] = PointRole::kIdle;
  rebuild_active(t.lattice);
  t.tracker.reset(t.lattice);
  EXPECT_THAT(t.break_all({0}), IsEmpty());
  EXPECT_THAT(t.break_all({2}), ElementsAre(Split{0, 1}));
  EXPECT_THAT(t.tracker.components().label, ElementsAre(-1, -1, -1, 1, 0, 0));
}

TEST(ComponentTracker, EdgesThatWereBrokenFromTheStartAreNoWayAround) {
  PhysicalModel rope = test::chain({.points = 5});
  rope.edges[EdgeId(0)].broken = true;
  Tracked t({rope});
  EXPECT_THAT(t.break_all({2}), ElementsAre(Split{1, 2}));
}

}  // namespace
}  // namespace limber
