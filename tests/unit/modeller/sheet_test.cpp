#include "core/modeller/sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/model/errors.h"
#include "core/model/validate.h"
#include "core/operators/boundary_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"

namespace limber {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

// 3 m along x by 2 m along z; du x dv is -y.
Vec3 rectangle(double u, double v) { return {3.0 * u, 0.0, 2.0 * v}; }

// A quarter of a cylinder of radius 1 and height 2 far from the origin; du x dv points outwards.
Vec3 quarter(double u, double v) {
  return Vec3(1e4, -2e4, 3e4) + Vec3(std::sin(pi / 2.0 * u), 2.0 * v, std::cos(pi / 2.0 * u));
}

// A whole cylinder, open at both ends.
Vec3 tube(double u, double v) { return {std::sin(2 * pi * u), 2.0 * v, std::cos(2 * pi * u)}; }

double area(const GeometricModel& g) {
  double sum = 0.0;
  for (const auto& [corners, cell] : g.faces) {
    const auto& [a, b, c] = corners;
    sum += 0.5 * (g.points[b] - g.points[a]).cross(g.points[c] - g.points[a]).norm();
  }
  return sum;
}

double volume(const GeometricModel& g) {
  double sum = 0.0;
  for (CellId c : ids_of(g.cells)) sum += cell_volume(g, c);
  return sum;
}

class Sheet : public testing::TestWithParam<SheetCells> {};
INSTANTIATE_TEST_SUITE_P(Cells, Sheet,
                         testing::Values(SheetCells::kTriangles, SheetCells::kSquares));

// Points - edges + faces of a disc is 1, of an open tube 0; the diagonals of squares that lie over
// another one are not edges of the surface.
int euler(const GeometricModel& g, SheetCells cells) {
  const int crossing = cells == SheetCells::kSquares ? int(g.cells.size()) : 0;
  return int(g.points.size()) - (int(g.edges.size()) - crossing) + int(g.faces.size());
}

TEST_P(Sheet, IsValidAndHasTheTopologyOfADisc) {
  for (const SheetGrid& grid :
       {SheetGrid{1, 1, GetParam()}, SheetGrid{4, 3, GetParam()}, SheetGrid{5, 4, GetParam()}}) {
    const GeometricModel g = sheet(rectangle, grid, "sheet");
    EXPECT_TRUE(validate(g, "sheet").empty());
    EXPECT_EQ(euler(g, GetParam()), 1);
    EXPECT_NEAR(area(g), 6.0, 1e-13);
    EXPECT_TRUE(validate(test::with_plausible_attributes(g, "sheet")).empty());
  }
}

TEST_P(Sheet, FacesLookToTheOuterSide) {
  const GeometricModel g = sheet(rectangle, {4, 3, GetParam()}, "sheet");
  for (const Face& f : g.faces) {
    const auto& [a, b, c] = f.corners;
    EXPECT_LT((g.points[b] - g.points[a]).cross(g.points[c] - g.points[a]).y(), 0.0);
  }
}

TEST_P(Sheet, AJoinedSheetIsATube) {
  const GeometricModel g = sheet(tube, {12, 5, GetParam(), true}, "tube");
  EXPECT_TRUE(validate(g, "tube").empty());
  EXPECT_EQ(euler(g, GetParam()), 0);
  EXPECT_EQ(g.points.size(), 12u * 6u);
}

TEST_P(Sheet, AreaConvergesWithTheSquareOfTheSpacing) {
  const auto error = [&](int n) { return pi - area(sheet(quarter, {n, n, GetParam()}, "sheet")); };
  EXPECT_NEAR(error(8) / error(16), 4.0, 0.4);
  EXPECT_NEAR(error(16) / error(32), 4.0, 0.2);
}

TEST_P(Sheet, ShellVolumeConvergesWithTheSquareOfTheSpacing) {
  const double exact = pi / 4.0 * (1.0 - 0.9 * 0.9) * 2.0;
  const auto error = [&](int n) {
    return exact - volume(shell_patch(quarter, {n, n, GetParam()}, 0.1, "shell"));
  };
  EXPECT_NEAR(error(8) / error(16), 4.0, 0.4);
  EXPECT_NEAR(error(16) / error(32), 4.0, 0.2);
}

TEST_P(Sheet, AShellIsClosed) {
  const GeometricModel g = shell_patch(quarter, {8, 6, GetParam()}, 0.1, "shell");
  EXPECT_TRUE(validate(g, "shell").empty());
  const SurfaceModel surface = boundary(test::with_plausible_attributes(g, "shell"));
  EXPECT_EQ(test::unmatched_sides(surface), 0);
  const int sides = 3 * int(surface.triangles.size()) / 2;
  EXPECT_EQ(int(surface.points.size()) - sides + int(surface.triangles.size()), 2);
}

TEST_P(Sheet, AJoinedShellIsARing) {
  const GeometricModel g = shell_patch(tube, {12, 5, GetParam(), true}, 0.1, "ring");
  EXPECT_TRUE(validate(g, "ring").empty());
  const SurfaceModel surface = boundary(test::with_plausible_attributes(g, "ring"));
  EXPECT_EQ(test::unmatched_sides(surface), 0);
  const int sides = 3 * int(surface.triangles.size()) / 2;
  EXPECT_EQ(int(surface.points.size()) - sides + int(surface.triangles.size()), 0);
}

TEST(SheetGridFor, MakesEquilateralTriangles) {
  const GeometricModel g = sheet(rectangle, grid_for(rectangle, 0.1), "sheet");
  for (const auto& [a, b] : g.edges) {
    const double length = (g.points[b] - g.points[a]).norm();
    EXPECT_LT(length, 0.102);
    EXPECT_GT(length, 0.049);  // half triangles at the ends of rows
  }
  const SheetGrid squares = grid_for(rectangle, 0.1, SheetCells::kSquares);
  EXPECT_EQ(squares.cells_u, 30);
  EXPECT_EQ(squares.cells_v, 20);
}

TEST(SheetErrors, NameTheDefect) {
  const auto cone = [](double u, double v) -> Vec3 { return v * tube(u, 0.0) + v * Vec3::UnitY(); };
  EXPECT_THAT(
      [&] {
        sheet(cone, {6, 3, SheetCells::kTriangles, true}, "cone");
      },
      ThrowsMessage<InputError>(HasSubstr("are in the same place")));
  EXPECT_THAT(
      [] {
        shell_patch(tube, {12, 5, SheetCells::kTriangles, true}, 1.5, "tube");
      },
      ThrowsMessage<InputError>(HasSubstr("a wall of 1.5 m turns it inside out")));
  EXPECT_THAT(
      [] {
        sheet(rectangle, {100000, 100000}, "sheet");
      },
      ThrowsMessage<InputError>(HasSubstr("1.00002e+10 points")));
  EXPECT_THROW(sheet(rectangle, {0, 1}, "sheet"), InputError);
  EXPECT_THROW(sheet(tube, {2, 1, SheetCells::kTriangles, true}, "tube"), InputError);
  EXPECT_THROW(sheet([](double, double) -> Vec3 { return Vec3(NAN, 0, 0); }, {1, 1}, "nan"),
               InputError);
  EXPECT_THROW(shell_patch(rectangle, {1, 1}, 0.0, "shell"), InputError);
  EXPECT_THROW(grid_for(rectangle, -1.0), InputError);
  EXPECT_THROW(grid_for(rectangle, 1e-9), InputError);
}

}  // namespace
}  // namespace limber
