#include "core/operators/breaking_operator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/model/errors.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

using test::block;
using test::block_edge;
using test::BlockShape;
using test::sheet;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Blow {
  BlockShape shape;
  PhysicalModel model = block(shape);
  BreakingResult result;

  Blow(const BlockShape& s, std::array<int, 3> from, std::array<int, 3> to) : shape(s) {
    const EdgeId edges[] = {block_edge(model, shape, from, to)};
    result = break_edges(model, edges);
  }
};

// The only cell goes, and all of 12 + 12 + 4 edges with it; nothing is left to be seen.
TEST(BreakEdges, OneCube) {
  const Blow blow({}, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(blow.result.broken_edges.size(), 28u);
  EXPECT_THAT(blow.result.invalid_cells, ElementsAre(0));
  EXPECT_THAT(blow.result.exposed_faces, IsEmpty());
  for (const EdgeAttributes& edge : blow.model.edges) EXPECT_TRUE(edge.broken);
}

// 2x2x2, the vertical edge in the middle of the lower layer: all four lower cells. What only they
// have: 6 + 6 edges of the bottom and 9 vertical ones; the 12 of the layer between stay with the
// upper cells. Exposed: the lower sides of the four upper cells, two triangles each.
TEST(BreakEdges, LowerLayerOfTwoByTwoByTwo) {
  const Blow blow({.cells = {2, 2, 2}, .edges = test::kAxial}, {1, 1, 0}, {1, 1, 1});
  EXPECT_EQ(blow.result.broken_edges.size(), 21u);
  EXPECT_THAT(blow.result.invalid_cells, ::testing::UnorderedElementsAre(0, 1, 2, 3));
  EXPECT_EQ(blow.result.exposed_faces.size(), 8u);
  for (std::int32_t f : blow.result.exposed_faces)
    EXPECT_GE(blow.model.geometry.faces[FaceId(std::size_t(f))].cell.value, 4);
}

// 3x3x3, a central edge: four of the nine cells of the middle layer, those with x, y in {0, 1}.
// Broken: its own 1 + 3 vertical edges that only these cells share, at (0,0), (0,1), (1,0); of the
// diagonals 4 x 4 in the bodies, 2 in each of the 4 squares between the cells, and 2 in each of the
// 4 squares on the surface of the block: 4 + 16 + 8 + 8.
// Exposed: of their 4 x 6 squares, 4 x 2 lie between them and 4 on the surface; 12 squares are
// left.
TEST(BreakEdges, CentralEdgeOfThreeByThreeByThree) {
  const Blow blow({.cells = {3, 3, 3}}, {1, 1, 1}, {1, 1, 2});
  EXPECT_EQ(blow.result.broken_edges.size(), 36u);
  EXPECT_THAT(blow.result.invalid_cells, ::testing::UnorderedElementsAre(9, 10, 12, 13));
  EXPECT_EQ(blow.result.exposed_faces.size(), 24u);
}

// 3x3x3, an edge on the surface, away from the block's own edges: the two cells on either side of
// it. Only axial edges: itself, and the one along the block's edge that only the lower cell has.
// Exposed: of 2 x 6 squares, 2 between the two, 2 at x = 0 and 1 at z = 0; 7 squares are left.
TEST(BreakEdges, SurfaceEdgeOfThreeByThreeByThree) {
  const Blow blow({.cells = {3, 3, 3}, .edges = test::kAxial}, {0, 1, 1}, {0, 2, 1});
  EXPECT_THAT(blow.result.broken_edges,
              ElementsAre(block_edge(blow.model, blow.shape, {0, 1, 1}, {0, 2, 1}).value,
                          block_edge(blow.model, blow.shape, {0, 1, 0}, {0, 2, 0}).value));
  EXPECT_EQ(blow.result.invalid_cells.size(), 2u);
  EXPECT_EQ(blow.result.exposed_faces.size(), 14u);
}

// A corner: its cell and the three edges that meet there; three inner squares are exposed.
TEST(BreakEdges, CornerOfThreeByThreeByThree) {
  const Blow blow({.cells = {3, 3, 3}, .edges = test::kAxial}, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(blow.result.broken_edges.size(), 3u);
  EXPECT_THAT(blow.result.invalid_cells, ElementsAre(0));
  EXPECT_EQ(blow.result.exposed_faces.size(), 6u);
}

// In the middle bar of three the outer cells keep the squares they shared with it.
TEST(BreakEdges, StateFollowsFromTheAttributesAfterEveryCall) {
  PhysicalModel m = block({.cells = {3, 1, 1}});
  const BreakingTopology topology = breaking_topology(m.geometry);
  BreakingState state = breaking_state(m, topology);
  const EdgeId middle[] = {block_edge(m, {.cells = {3, 1, 1}}, {1, 0, 0}, {2, 0, 0})};
  const std::int32_t index[] = {middle[0].value};
  const BreakingResult a = break_edges(topology, state, index);
  const BreakingResult b = break_edges(m, middle);
  const BreakingState fresh = breaking_state(m, topology);
  EXPECT_EQ(a.broken_edges, b.broken_edges);
  EXPECT_EQ(state.edge_broken, fresh.edge_broken);
  EXPECT_EQ(state.valid_cells, fresh.valid_cells);
  EXPECT_EQ(state.cell_valid, fresh.cell_valid);
  EXPECT_EQ(state.face_external, fresh.face_external);
  // Two cells of 12 faces each, all of them external now.
  EXPECT_EQ(std::count(fresh.face_external.begin(), fresh.face_external.end(), 1), 24);
}

TEST(BreakEdges, RepeatedAndAlreadyBrokenEdgesAreIgnored) {
  PhysicalModel m = block({.cells = {3, 3, 3}});
  const EdgeId twice[] = {EdgeId(0), EdgeId(0)};
  const BreakingResult first = break_edges(m, twice);
  EXPECT_EQ(std::count(first.broken_edges.begin(), first.broken_edges.end(), 0), 1);
  const BreakingResult second = break_edges(m, twice);
  EXPECT_THAT(second.broken_edges, IsEmpty());
  EXPECT_THAT(second.invalid_cells, IsEmpty());
  EXPECT_THAT(second.exposed_faces, IsEmpty());
}

TEST(BreakEdges, NothingToBreakBreaksNothing) {
  PhysicalModel m = block({});
  EXPECT_THAT(break_edges(m, {}).broken_edges, IsEmpty());
}

// A rope has no cells: an edge breaks alone.
TEST(BreakEdges, EdgeWithoutCellsBreaksAlone) {
  GeometricModelBuilder builder;
  builder.begin_subobject("rope");
  for (int i = 0; i < 4; ++i) builder.add_point(Vec3(i, 0, 0));
  for (std::size_t i = 0; i < 3; ++i) builder.edge(PointId(i), PointId(i + 1));
  PhysicalModel m = test::with_plausible_attributes(builder.finish(), "rope");
  const EdgeId edges[] = {EdgeId(1)};
  EXPECT_THAT(break_edges(m, edges).broken_edges, ElementsAre(1));
  EXPECT_FALSE(m.edges[EdgeId(0)].broken);
  EXPECT_FALSE(m.edges[EdgeId(2)].broken);
}

// Edge 4 is the diagonal of the first square: both of its triangles lose a side.
TEST(BreakEdges, SheetFacesVanishWithAnEdge) {
  const PhysicalModel m = sheet(2, false);
  const BreakingTopology topology = breaking_topology(m.geometry);
  BreakingState state = breaking_state(m, topology);
  EXPECT_THAT(state.face_external, ::testing::Each(1));
  const std::int32_t diagonal[] = {4};
  const BreakingResult result = break_edges(topology, state, diagonal);
  EXPECT_THAT(result.broken_edges, ElementsAre(4));
  EXPECT_THAT(state.face_external, ElementsAre(0, 0, 1, 1, 1, 1, 1, 1));
}

// A 2-D cell takes its two triangles and the edges nobody shares: 5 less the 2 inner sides.
TEST(BreakEdges, PolygonCellBreaksAsAWhole) {
  PhysicalModel m = sheet(2, true);
  const EdgeId diagonal[] = {EdgeId(4)};
  const BreakingResult result = break_edges(m, diagonal);
  EXPECT_THAT(result.broken_edges, ElementsAre(4, 0, 3));
  EXPECT_THAT(result.invalid_cells, ElementsAre(0));
  EXPECT_THAT(result.exposed_faces, IsEmpty());
}

TEST(BreakEdges, UnknownEdgeIsAnInputErrorThatNamesIt) {
  PhysicalModel m = block({.name = "box"});
  const EdgeId edges[] = {EdgeId(500)};
  try {
    break_edges(m, edges);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, "box: edge 500");
  }
}

// The two cells of a bar: their common square is the only one with reverse faces.
TEST(BreakingTopology, LinksRunBothWays) {
  const PhysicalModel m = block({.cells = {2, 1, 1}, .edges = test::kAxial});
  const BreakingTopology t = breaking_topology(m.geometry);
  EXPECT_EQ(t.cell_edges.rows(), 2u);
  EXPECT_EQ(t.cell_edges[0].size(), 12u);
  EXPECT_EQ(t.cell_faces[1].size(), 12u);
  int shared_edges = 0, twins = 0;
  for (std::size_t e = 0; e < t.edge_cells.rows(); ++e) shared_edges += t.edge_cells[e].size() == 2;
  for (std::size_t f = 0; f < t.face_twin.size(); ++f) {
    if (t.face_twin[f].face < 0) continue;
    ++twins;
    EXPECT_EQ(t.face_twin[t.face_twin[f].face].face, static_cast<int>(f));
    EXPECT_EQ(t.face_twin[f].cell, t.face_cell[t.face_twin[f].face]);
    EXPECT_NE(t.face_twin[f].cell, t.face_cell[f]);
  }
  EXPECT_EQ(shared_edges, 4);
  EXPECT_EQ(twins, 4);
}

}  // namespace
}  // namespace limber
