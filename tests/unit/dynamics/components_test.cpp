#include "core/dynamics/components.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/lattices.h"

namespace limber {
namespace {

using testing::ElementsAre;
using Pairs = std::vector<std::array<int, 2>>;

Lattice graph(int points, const Pairs& edges) {
  GeometricModelBuilder builder;
  builder.begin_subobject("graph");
  for (int i = 0; i < points; ++i) builder.add_point({1.0 * i, 0.5 * i * i, 0.0});
  for (const auto& [a, b] : edges) builder.edge(PointId(std::size_t(a)), PointId(std::size_t(b)));
  PhysicalModel model = with_default_attributes(builder.finish(), "graph");
  for (PointAttributes& p : model.points) p.mass = 1.0;
  for (EdgeAttributes& e : model.edges) e.stiffness = 1.0;
  return test::lattice_of({model});
}

void break_one(Lattice& lattice, std::int32_t edge) {
  const std::vector<std::int32_t> edges = {edge};
  break_edges(lattice.topology, lattice.breaking, edges);
}

TEST(Components, CountPiecesInTheOrderOfTheirSmallestPoint) {
  const Components found = components(graph(7, {{5, 6}, {6, 0}, {4, 1}, {2, 4}}));
  EXPECT_EQ(found.count, 3);
  EXPECT_THAT(found.label, ElementsAre(0, 1, 1, 2, 1, 0, 0));
}

TEST(Components, DoNotDependOnTheOrderOfTheEdges) {
  Pairs edges = {{0, 9}, {9, 4}, {3, 7}, {7, 1}, {1, 8}, {2, 5}};
  std::sort(edges.begin(), edges.end());
  const std::vector<std::int32_t> wanted = components(graph(10, edges)).label;
  EXPECT_THAT(wanted, ElementsAre(0, 1, 2, 1, 0, 2, 3, 1, 1, 0));
  int orders = 0;
  while (std::next_permutation(edges.begin(), edges.end()) && ++orders < 200) {
    EXPECT_EQ(components(graph(10, edges)).label, wanted);
  }
}

TEST(Components, SplitWhereAnEdgeBroke) {
  Lattice lattice = test::lattice_of({test::chain({.points = 5})});
  EXPECT_EQ(components(lattice).count, 1);
  break_one(lattice, 2);  // between points 2 and 3, before the active list knows
  EXPECT_THAT(components(lattice).label, ElementsAre(0, 0, 0, 1, 1));
  rebuild_active(lattice);
  EXPECT_THAT(components(lattice).label, ElementsAre(0, 0, 0, 1, 1));
}

TEST(Components, DoNotCrossObjects) {
  const Lattice lattice = test::lattice_of(
      {test::chain({.points = 2}), test::chain({.points = 3, .origin = {0.0, 5.0, 0.0}})});
  EXPECT_THAT(components(lattice).label, ElementsAre(0, 0, 1, 1, 1));
}

TEST(Components, LeaveOutPointsThatAreNotDynamic) {
  Lattice lattice = test::lattice_of({test::chain({.points = 2}),
                                      test::chain({.points = 2, .origin = {0.0, 5.0, 0.0}}),
                                      test::chain({.points = 2, .origin = {0.0, 9.0, 0.0}})});
  lattice.role[0] = lattice.role[1] = PointRole::kIdle;
  lattice.role[2] = lattice.role[3] = PointRole::kCarried;
  rebuild_active(lattice);
  const Components found = components(lattice);
  EXPECT_THAT(found.label, ElementsAre(-1, -1, -1, -1, 0, 0));
  EXPECT_THAT(points_of(found), ElementsAre(ElementsAre(4, 5)));
}

TEST(Components, ListTheirPointsAscending) {
  const auto points = points_of(components(graph(6, {{5, 0}, {3, 5}, {4, 1}})));
  EXPECT_THAT(points, ElementsAre(ElementsAre(0, 3, 5), ElementsAre(1, 4), ElementsAre(2)));
}

}  // namespace
}  // namespace limber
