#include "core/operators/boundary_tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/dynamics/lattice.h"
#include "core/operators/boundary_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"
#include "tests/support/measure.h"

namespace limber {
namespace {

using testing::IsEmpty;

std::vector<std::array<int, 3>> corners(const SurfaceModel& surface) {
  std::vector<std::array<int, 3>> all;
  for (const SurfaceTriangle& t : surface.triangles) all.push_back(t.corners);
  return all;
}

void expect_same(const SurfaceModel& tracked, const SurfaceModel& from_scratch) {
  EXPECT_EQ(corners(tracked), corners(from_scratch));
  EXPECT_EQ(tracked.source_point, from_scratch.source_point);
  EXPECT_EQ(tracked.points, from_scratch.points);
  EXPECT_EQ(tracked.subobject_names, from_scratch.subobject_names);
  EXPECT_EQ(tracked.subobject_surfaces.size(), from_scratch.subobject_surfaces.size());
  ASSERT_EQ(tracked.triangles.size(), from_scratch.triangles.size());
  for (std::size_t i = 0; i < tracked.triangles.size(); ++i) {
    EXPECT_EQ(tracked.triangles[i].source, from_scratch.triangles[i].source);
    EXPECT_EQ(tracked.triangles[i].subobject, from_scratch.triangles[i].subobject);
    EXPECT_EQ(tracked.triangles[i].exposed_by_breaking,
              from_scratch.triangles[i].exposed_by_breaking);
  }
}

void break_one(Lattice& lattice, BoundaryTracker& tracker, std::int32_t edge) {
  tracker.update(lattice.topology,
                 break_edges(lattice.topology, lattice.breaking, std::vector<std::int32_t>{edge}));
}

// A bar of two cubes: twelve triangles leave, the two between the cubes enter.
TEST(BoundaryTracker, WhatABrokenCellLeavesBehindEnters) {
  Lattice lattice = test::lattice_of({test::block({.cells = {2, 1, 1}})});
  BoundaryTracker tracker;
  tracker.reset(lattice.breaking);
  EXPECT_EQ(tracker.faces().size(), 20u);
  break_one(lattice, tracker, 0);
  EXPECT_EQ(tracker.faces().size(), 12u);
  expect_same(
      tracker.surface(lattice.objects[0].authored, lattice.topology, lattice.objects[0].faces),
      boundary(extract_model(lattice, 0)));
}

TEST(BoundaryTracker, NothingIsLeftOfABrokenCube) {
  Lattice lattice = test::lattice_of({test::block({})});
  BoundaryTracker tracker;
  tracker.reset(lattice.breaking);
  break_one(lattice, tracker, 0);
  EXPECT_THAT(tracker.faces(), IsEmpty());
}

// Edge 1 of the sheet of 2x2 squares has a triangle on either side.
TEST(BoundaryTracker, SheetFacesLeaveWithTheirEdges) {
  Lattice lattice = test::lattice_of({test::sheet(2, false)});
  BoundaryTracker tracker;
  tracker.reset(lattice.breaking);
  break_one(lattice, tracker, 1);
  EXPECT_EQ(tracker.faces().size(), 6u);
  break_one(lattice, tracker, 1);
  EXPECT_EQ(tracker.faces().size(), 6u);
}

TEST(BoundaryTracker, StartsWithWhatIsBrokenAlready) {
  PhysicalModel bar = test::block({.cells = {3, 1, 1}});
  break_edges(bar, std::vector<EdgeId>{EdgeId(0)});
  const Lattice lattice = test::lattice_of({bar});
  BoundaryTracker tracker;
  tracker.reset(lattice.breaking);
  EXPECT_EQ(tracker.faces().size(), boundary(bar).triangles.size());
}

// The compiled indices of the second and third object do not start at 0.
TEST(BoundaryTracker, ObjectsHaveTheirOwnSurfaces) {
  Lattice lattice =
      test::lattice_of({test::block({.cells = {2, 2, 1}, .name = "plate"}), test::sheet(3, false),
                        test::block({.cells = {2, 1, 2}, .name = "wall"})});
  BoundaryTracker tracker;
  tracker.reset(lattice.breaking);
  for (std::size_t o = 0; o < lattice.objects.size(); ++o) {
    break_one(lattice, tracker, lattice.objects[o].edges.begin + 1);
  }
  for (std::size_t o = 0; o < lattice.objects.size(); ++o) {
    const PhysicalModel now = extract_model(lattice, o);
    const SurfaceModel surface = tracker.surface(now, lattice.topology, lattice.objects[o].faces);
    expect_same(surface, boundary(now));
    EXPECT_GT(surface.triangles.size(), 0u);
    EXPECT_EQ(test::unmatched_sides(surface) == 0, o != 1);  // a sheet is not closed
  }
}

TEST(Boundary, WithTheLinksAtHandIsTheSame) {
  PhysicalModel plate = test::block({.cells = {3, 2, 1}});
  const BreakingTopology topology = breaking_topology(plate.geometry);
  break_edges(plate, std::vector<EdgeId>{EdgeId(4)});
  expect_same(boundary(plate, topology), boundary(plate));
}

}  // namespace
}  // namespace limber
