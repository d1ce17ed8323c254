#include "core/modeller/box_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/operators/boundary_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"

namespace limber {
namespace {

GeometricModel box(std::array<int, 3> cells, CellEdges edges = {}) {
  return box_lattice(cells, {0.1, 0.2, 0.3}, {1.0, 2.0, 3.0}, "box", edges);
}

// nx (ny+1) (nz+1) and so on along the axes, 2 nx ny (nz+1) and so on across the squares, 4 a cell.
TEST(BoxLattice, HasTheCountsOfTheFormulas) {
  const GeometricModel g = box({2, 3, 4});
  const std::size_t axial = 2 * 4 * 5 + 3 * 3 * 5 + 4 * 3 * 4;
  const std::size_t across = 2 * (2 * 3 * 5 + 2 * 4 * 4 + 3 * 4 * 3);
  EXPECT_EQ(g.points.size(), 3u * 4u * 5u);
  EXPECT_EQ(g.cells.size(), 24u);
  EXPECT_EQ(g.faces.size(), 24u * 12u);
  EXPECT_EQ(g.edges.size(), axial + across + 4 * 24);
  EXPECT_EQ(box({2, 3, 4}, {.face_diagonals = false, .body_diagonals = false}).edges.size(), axial);
  EXPECT_EQ(box({2, 3, 4}, {.face_diagonals = true, .body_diagonals = false}).edges.size(),
            axial + across);
}

using Ends = std::set<std::pair<PointId, PointId>>;

Ends ends_of(const GeometricModel& g) {
  Ends ends;
  for (const Edge& e : g.edges) ends.insert({std::min(e.a, e.b), std::max(e.a, e.b)});
  return ends;
}

// Against the tests' own builder, edge by edge.
TEST(BoxLattice, OneFaceDiagonalRunsFromTheLowestCorner) {
  const CellEdges one = {
      .face_diagonals = false, .body_diagonals = false, .one_face_diagonal = true};
  const GeometricModel g = box({2, 3, 4}, one);
  test::BlockShape shape;
  shape.cells = {2, 3, 4};
  shape.edges = {.one_diagonal = true};
  EXPECT_EQ(ends_of(g), ends_of(test::block_geometry(shape)));
}

TEST(BoxLattice, ACellHas28Edges) {
  const GeometricModel g = box({1, 1, 1});
  EXPECT_EQ(g.cells[CellId(std::size_t{0})].edges.size(), 28u);
}

TEST(BoxLattice, CellsFillTheBox) {
  const GeometricModel g = box({2, 3, 4});
  for (CellId c : ids_of(g.cells)) EXPECT_NEAR(cell_volume(g, c), 0.1 * 0.2 * 0.3, 1e-15);
}

TEST(BoxLattice, PointsRunAlongXFirst) {
  const GeometricModel g = box({2, 3, 4});
  EXPECT_TRUE(g.points[PointId(std::size_t{0})].isApprox(Vec3(1.0, 2.0, 3.0)));
  EXPECT_TRUE(g.points[PointId(std::size_t{1})].isApprox(Vec3(1.1, 2.0, 3.0)));
  EXPECT_TRUE(g.points[PointId(std::size_t{3})].isApprox(Vec3(1.0, 2.2, 3.0)));
  EXPECT_TRUE(g.points[PointId(std::size_t{12})].isApprox(Vec3(1.0, 2.0, 3.3)));
}

TEST(BoxLattice, SurfaceIsClosedAndHoldsTheVolume) {
  PhysicalModel model = test::with_plausible_attributes(box({3, 2, 2}), "box");
  EXPECT_TRUE(validate(model).empty());
  const SurfaceModel surface = boundary(model);
  EXPECT_EQ(surface.triangles.size(), 2u * 2u * (3 * 2 + 2 * 2 + 3 * 2));
  EXPECT_EQ(test::unmatched_sides(surface), 0);
  EXPECT_NEAR(test::enclosed_volume(surface), 0.3 * 0.4 * 0.6, 1e-14);
}

TEST(BoxLattice, RefusesWhatIsNoBox) {
  EXPECT_THROW(box({1, 0, 1}), InputError);
  EXPECT_THROW(box_lattice({1, 1, 1}, {0.1, -0.1, 0.1}, Vec3::Zero(), "box"), InputError);
  EXPECT_THROW(box_lattice({1, 1, 1}, {0.1, 0.1, NAN}, Vec3::Zero(), "box"), InputError);
}

}  // namespace
}  // namespace limber
