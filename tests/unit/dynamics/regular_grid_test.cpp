#include "core/dynamics/regular_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "core/modeller/box_lattice.h"
#include "core/modeller/particle_cloud.h"
#include "core/modeller/rope.h"
#include "core/modeller/round_solids.h"
#include "core/modeller/sheet.h"
#include "core/modeller/voxel_lattice.h"
#include "core/operators/gluing_operator.h"
#include "tests/property/generators.h"
#include "tests/support/blocks.h"

namespace limber {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

PhysicalModel box(std::array<int, 3> cells, const Vec3& spacing,
                  const Vec3& origin = Vec3::Zero()) {
  return test::with_plausible_attributes(box_lattice(cells, spacing, origin, "box"), "box");
}

PhysicalModel cube(int cells, const Vec3& origin = Vec3::Zero()) {
  return box({cells, cells, cells}, Vec3::Constant(0.1), origin);
}

// Some of the cells of a grid of 0.1 m, in the order of the grid.
PhysicalModel voxels(std::array<int, 3> cells, const std::vector<std::int32_t>& kept) {
  const VoxelGrid grid = {
      .origin = Vec3::Zero(), .spacing = 0.1, .cells = {cells[0], cells[1], cells[2]}};
  return test::with_plausible_attributes(voxel_lattice(grid, kept, {}, "voxels").geometry,
                                         "voxels");
}

GridStep place_of(const RegularGrid& grid, std::int32_t cell) {
  return {cell % grid.size[0], cell / grid.size[0] % grid.size[1],
          cell / grid.size[0] / grid.size[1]};
}

// The cell that half of a cell's leads to; -1 outside of the grid.
std::int32_t neighbour(const RegularGrid& grid, std::int32_t cell, int half) {
  const GridStep& step = kGridSteps[half / 2];
  GridStep at = place_of(grid, cell);
  for (int axis = 0; axis < 3; ++axis) {
    at[axis] += half % 2 == 0 ? step[axis] : -step[axis];
    if (at[axis] < 0 || at[axis] >= grid.size[axis]) return -1;
  }
  return grid.cell_of(at);
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-7 * std::abs(a); }

// What is wrong with the grids of a model; empty for nothing.
class Inspection {
 public:
  Inspection(const PhysicalModel& model, const std::vector<RegularGrid>& grids) : model_(model) {
    for (const RegularGrid& grid : grids) inspect(grid);
  }
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  using ClassKey = std::pair<int, int>;  // direction, class

  void require(bool holds, const std::string& what) {
    if (!holds) complaints_.push_back(what);
  }
  void inspect(const RegularGrid& grid);
  void inspect_points(const RegularGrid& grid);
  void inspect_ends(const RegularGrid& grid, const GridSpring& spring);
  void inspect_constants(const RegularGrid& grid, const GridSpring& spring);

  const PhysicalModel& model_;
  std::vector<std::string> complaints_;
  std::set<std::int32_t> points_, edges_;
  std::set<std::pair<std::int32_t, int>> halves_;  // cell, half: of the grid that is inspected
  std::map<ClassKey, SpringClass> least_;          // thresholds of its springs
};

void Inspection::inspect(const RegularGrid& grid) {
  halves_.clear();
  least_.clear();
  inspect_points(grid);
  for (const GridSpring& spring : grid.springs) {
    require(edges_.insert(spring.edge.value).second, "an edge is there twice");
    inspect_ends(grid, spring);
    inspect_constants(grid, spring);
  }
  for (int d = 0; d < kGridDirections; ++d) {
    require(grid.classes[d].size() <= kMostSpringClasses, "too many classes");
    for (std::size_t c = 0; c < grid.classes[d].size(); ++c) {
      const SpringClass& expected = least_[{d, static_cast<int>(c)}];
      require(grid.classes[d][c].break_threshold == expected.break_threshold, "not the least");
      require(grid.classes[d][c].crush_threshold == expected.crush_threshold, "not the least");
    }
  }
}

void Inspection::inspect_points(const RegularGrid& grid) {
  const std::size_t cells = std::size_t(grid.size[0]) * grid.size[1] * grid.size[2];
  require(grid.point.size() == cells, "the number of cells is not that of the box");
  for (std::int32_t p : grid.point) {
    require(p >= -1 && p < static_cast<std::int32_t>(model_.points.size()), "no such point");
    if (p >= 0) require(points_.insert(p).second, "a point is there twice");
  }
}

void Inspection::inspect_ends(const RegularGrid& grid, const GridSpring& spring) {
  const Edge& edge = model_.geometry.edges[spring.edge];
  const std::int32_t other = neighbour(grid, spring.cell, spring.half);
  require(other >= 0, "a spring leads out of the grid");
  if (other < 0) return;
  require(grid.point[spring.cell] == edge.a.value, "not the edge's first point");
  require(grid.point[other] == edge.b.value, "not the edge's second point");
  require(halves_.insert({spring.cell, spring.half}).second, "two springs at one place");
  require(halves_.insert({other, spring.half ^ 1}).second, "two springs at one place");
}

void Inspection::inspect_constants(const RegularGrid& grid, const GridSpring& spring) {
  const EdgeAttributes& edge = model_.edges[spring.edge];
  const int direction = spring.half / 2;
  require(near(grid.rest_length[direction], edge.rest_length), "another rest length");
  require(spring.spring_class < grid.classes[direction].size(), "no such class");
  if (spring.spring_class >= grid.classes[direction].size()) return;
  const SpringClass& constants = grid.classes[direction][spring.spring_class];
  require(near(constants.stiffness, edge.stiffness), "another stiffness");
  require(near(constants.damping, edge.damping), "another damping");
  SpringClass& least = least_[{direction, spring.spring_class}];
  least.break_threshold = std::min(least.break_threshold, edge.break_threshold);
  least.crush_threshold = std::min(least.crush_threshold, edge.crush_threshold);
}

std::vector<std::string> complaints(const PhysicalModel& model,
                                    const std::vector<RegularGrid>& grids) {
  return Inspection(model, grids).complaints();
}

std::size_t springs_in(const std::vector<RegularGrid>& grids) {
  std::size_t springs = 0;
  for (const RegularGrid& grid : grids) springs += grid.springs.size();
  return springs;
}

std::vector<std::int32_t> counted(std::size_t n) {
  std::vector<std::int32_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// One grid with every edge, whose cells are the points in the order in which they were made.
void expect_whole(const PhysicalModel& model, std::array<std::int32_t, 3> size) {
  const auto grids = regular_grids(model);
  ASSERT_THAT(grids, SizeIs(1));
  EXPECT_EQ(grids[0].size, size);
  EXPECT_EQ(grids[0].point, counted(model.points.size()));
  EXPECT_EQ(grids[0].springs.size(), model.edges.size());
  EXPECT_THAT(complaints(model, grids), IsEmpty());
}

// ---------------------------------------------------------------------------------------------

TEST(RegularGrid, DirectionsAreAllNeighboursThatComeAfter) {
  std::set<int> after;
  for (const GridStep& s : kGridSteps) after.insert(s[0] + 3 * s[1] + 9 * s[2]);
  EXPECT_THAT(after, SizeIs(kGridDirections));
  EXPECT_EQ(*after.begin(), 1);  // of -13 to 13; 0 is the cell itself
  EXPECT_EQ(*after.rbegin(), 13);
}

TEST(RegularGrid, OfABoxIsTheBox) { expect_whole(box({7, 4, 5}, Vec3::Constant(0.1)), {8, 5, 6}); }

TEST(RegularGrid, OfAFlatOrLongBoxIsTheBox) {
  expect_whole(box({9, 6, 1}, Vec3::Constant(0.1)), {10, 7, 2});
  expect_whole(box({1, 1, 40}, Vec3::Constant(0.1)), {2, 2, 41});
}

TEST(RegularGrid, MayBeTurnedAndMoved) {
  for (double angle : {0.3, 1.1, 2.5, 3.1}) {
    PhysicalModel model = box({7, 4, 5}, Vec3::Constant(0.1));
    const Vec3 axis = Vec3(1.0, 2.0, -1.5).normalized();
    place(model, Eigen::AngleAxisd(angle, axis).toRotationMatrix(), {1e3, -20.0, 0.3});
    SCOPED_TRACE(angle);
    expect_whole(model, {8, 5, 6});
  }
}

TEST(RegularGrid, MayHaveAnotherSpacingAlongEachAxis) {
  for (const Vec3& spacing : {Vec3(0.1, 0.13, 0.17), Vec3(0.17, 0.1, 0.13), Vec3(0.3, 0.2, 0.1),
                              Vec3(0.1, 0.1, 0.5), Vec3(1.0, 0.2, 0.25)}) {
    SCOPED_TRACE(spacing.transpose());
    expect_whole(box({5, 6, 4}, spacing), {6, 7, 5});
  }
}

TEST(RegularGrid, MayHaveEdgesAlongTheAxesAlone) {
  expect_whole(test::block({.cells = {6, 6, 6}, .edges = test::kAxial}), {7, 7, 7});
}

TEST(RegularGrid, MayBeMirrored) {
  PhysicalModel model = box({7, 4, 5}, Vec3::Constant(0.1));
  for (Vec3& x : model.geometry.points) x.z() = -x.z();
  const auto grids = regular_grids(model);
  EXPECT_EQ(springs_in(grids), model.edges.size());
  EXPECT_THAT(complaints(model, grids), IsEmpty());
}

TEST(RegularGrid, IsFlatForAFlatSheetOfSquares) {
  const auto plane = [](double u, double v) { return Vec3(1.2 * u, 0.4, 1.0 * v); };
  const SheetGrid grid = {.cells_u = 12, .cells_v = 10, .cells = SheetCells::kSquares};
  expect_whole(test::with_plausible_attributes(sheet(plane, grid, "sheet"), "sheet"), {13, 11, 1});
}

TEST(RegularGrid, MayHaveHoles) {
  std::vector<std::int32_t> kept;
  for (std::int32_t c = 0; c < 8 * 8 * 8; ++c) {
    const bool hole = c % 8 >= 3 && c % 8 <= 5 && c / 8 % 8 >= 2 && c / 8 % 8 <= 5;
    if (!hole && c % 11 != 0) kept.push_back(c);
  }
  const PhysicalModel model = voxels({8, 8, 8}, kept);
  const auto grids = regular_grids(model);
  ASSERT_THAT(grids, SizeIs(1));
  EXPECT_EQ(grids[0].springs.size(), model.edges.size());
  EXPECT_THAT(complaints(model, grids), IsEmpty());
}

// Layers around a middle block: regular in there at most.
TEST(RegularGrid, OfABallIsSound) {
  const PhysicalModel ball = test::with_plausible_attributes(
      solid_sphere({.radius = 1.0, .cells_across = 16}, "ball"), "ball");
  EXPECT_THAT(complaints(ball, regular_grids(ball)), IsEmpty());
}

// ---------------------------------------------------------------------------------------------

GlueResult glued(const Vec3& beside, double distance) {
  return glue(cube(5), cube(5, beside), {.distance = distance, .stiffness = 7.0});
}

TEST(RegularGrid, GoesOnThroughGlueThatIsAStepLong) {
  const PhysicalModel model = glued({0.6, 0.0, 0.0}, 0.15).model;
  const auto grids = regular_grids(model);
  ASSERT_THAT(grids, SizeIs(1));
  EXPECT_EQ(grids[0].springs.size(), model.edges.size());
  EXPECT_THAT(complaints(model, grids), IsEmpty());
}

TEST(RegularGrid, EndsAtGlueThatIsNoStep) {
  const GlueResult result = glued({0.55, 0.05, 0.03}, 0.09);
  ASSERT_GT(result.bonds, 0u);
  const auto grids = regular_grids(result.model);
  ASSERT_THAT(grids, SizeIs(2));
  EXPECT_EQ(springs_in(grids), result.model.edges.size() - result.bonds);
  EXPECT_THAT(complaints(result.model, grids), IsEmpty());
}

// Each in its own spacing, turned against the other.
TEST(RegularGrid, OfEachPartOfAModel) {
  PhysicalModel other = box({4, 6, 4}, Vec3::Constant(0.07), {0.0, 0.0, 0.55});
  place(other, Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero());
  const GlueResult result = glue(cube(5), other, {.distance = 0.07, .stiffness = 7.0});
  const auto grids = regular_grids(result.model);
  ASSERT_THAT(grids, SizeIs(2));
  EXPECT_THAT(complaints(result.model, grids), IsEmpty());
  EXPECT_GE(springs_in(grids), result.model.edges.size() - result.bonds);
}

TEST(RegularGrid, ThereIsNoneInARopeAShellAndGrains) {
  std::vector<Vec3> points;
  for (int i = 0; i < 600; ++i) points.push_back({0.01 * i, 0.0, 0.0});
  EXPECT_THAT(regular_grids(test::with_plausible_attributes(rope(points, "rope"), "rope")),
              IsEmpty());
  EXPECT_THAT(
      regular_grids(test::with_plausible_attributes(particle_cloud(points, "grains"), "grains")),
      IsEmpty());
  const auto arch = [](double u, double v) {
    const double angle = u * std::numbers::pi;
    return Vec3(std::cos(angle), std::sin(angle), v);
  };
  const GeometricModel shell = shell_patch(arch, grid_for(arch, 0.08), 0.05, "shell");
  EXPECT_THAT(regular_grids(test::with_plausible_attributes(shell, "shell")), IsEmpty());
  EXPECT_THAT(regular_grids(PhysicalModel{}), IsEmpty());
}

TEST(RegularGrid, IsNotWorthItForAFewCells) {
  EXPECT_THAT(regular_grids(cube(2)), IsEmpty());
  // Cells along the three edges of a large box: most of the grid is empty.
  std::vector<std::int32_t> kept;
  for (int i = 0; i < 30; ++i) kept.push_back(i);
  for (int i = 1; i < 30; ++i) kept.push_back(30 * i);
  for (int i = 1; i < 30; ++i) kept.push_back(900 * i);
  EXPECT_THAT(regular_grids(voxels({30, 30, 30}, kept)), IsEmpty());
}

// ---------------------------------------------------------------------------------------------

TEST(RegularGrid, LeavesOutAnOddRestLength) {
  const PhysicalModel sound = cube(5);
  for (std::size_t odd : {std::size_t{0}, std::size_t{100}, sound.edges.size() - 1}) {
    PhysicalModel model = sound;
    model.edges[EdgeId(odd)].rest_length *= 1.01;
    const auto grids = regular_grids(model);
    EXPECT_EQ(springs_in(grids), model.edges.size() - 1) << "edge " << odd;
    EXPECT_THAT(complaints(model, grids), IsEmpty());
  }
}

// Stiffness i at every 20th edge along x: 15 classes of that direction find room.
TEST(RegularGrid, LeavesOutTheSixteenthClassOfADirection) {
  PhysicalModel model = cube(5);
  std::array<std::size_t, 20> edges_of = {};
  int along_x = 0;
  for (EdgeId e : ids_of(model.edges)) {
    const Edge& edge = model.geometry.edges[e];
    const Vec3 d = model.geometry.points[edge.b] - model.geometry.points[edge.a];
    if (std::abs(d.y()) + std::abs(d.z()) > 1e-9) continue;
    const int i = along_x++ % 20;
    ++edges_of[i];
    model.edges[e].stiffness = 100.0 + i;
  }
  const auto grids = regular_grids(model);
  const std::size_t left_out = std::accumulate(edges_of.begin() + 15, edges_of.end(), 0u);
  ASSERT_GT(left_out, 0u);
  EXPECT_EQ(springs_in(grids), model.edges.size() - left_out);
  EXPECT_THAT(complaints(model, grids), IsEmpty());
}

TEST(RegularGrid, SurvivesBrokenGeometry) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const Vec3& bad : {Vec3(0.0, 0.0, 0.0), Vec3(nan, 0.1, 0.1), Vec3(0.1, inf, 0.2),
                          Vec3(1e300, 1e300, -1e300), Vec3(1e-300, 0.0, 0.0)}) {
    for (std::size_t every : {1u, 2u, 3u, 50u}) {
      PhysicalModel model = cube(5);
      for (std::size_t p = 0; p < model.points.size(); p += every)
        model.geometry.points[PointId(p)] = bad;
      EXPECT_THAT(complaints(model, regular_grids(model)), IsEmpty())
          << bad.transpose() << " every " << every;
    }
  }
}

TEST(RegularGrid, MayBeBentALittle) {
  const PhysicalModel straight = box({20, 5, 5}, Vec3::Constant(0.1));
  PhysicalModel bent = straight;
  for (Vec3& x : bent.geometry.points) x.y() += 0.05 * x.x() * x.x();  // slopes to 0.2
  const auto grids = regular_grids(bent);
  ASSERT_THAT(grids, SizeIs(1));
  EXPECT_EQ(grids[0].size, (std::array<std::int32_t, 3>{21, 6, 6}));
  EXPECT_EQ(grids[0].springs.size(), bent.edges.size());
  EXPECT_THAT(complaints(bent, grids), IsEmpty());
}

// ---------------------------------------------------------------------------------------------

// Whatever the size of the case.
int random_int(int low, int end) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, end));
}

// Cells of a random box, each kept by the same chance, turned, and no point where it should be.
PhysicalModel random_voxels(int least_cells, double chance) {
  std::array<int, 3> cells;
  for (int& n : cells) n = random_int(least_cells, 9);
  std::vector<std::int32_t> kept;
  for (std::int32_t c = 0; c < cells[0] * cells[1] * cells[2]; ++c)
    if (test::uniform(0.0, 1.0) < chance) kept.push_back(c);
  if (kept.empty()) kept.push_back(0);
  PhysicalModel model = voxels(cells, kept);
  const Vec3 axis = (test::random_vector(1.0) + Vec3(0.0, 0.0, 1e-3)).normalized();
  place(model, Eigen::AngleAxisd(test::uniform(0.0, 6.0), axis).toRotationMatrix(),
        test::random_vector(100.0));
  const double jitter = test::uniform(0.0, 0.004);
  for (Vec3& x : model.geometry.points) x += test::random_vector(jitter);
  return model;
}

void set_random_constants(PhysicalModel& model, int kinds) {
  for (EdgeId e : ids_of(model.edges)) {
    if (test::coin()) std::swap(model.geometry.edges[e].a, model.geometry.edges[e].b);
    EdgeAttributes& edge = model.edges[e];
    edge.stiffness = 100.0 * random_int(0, kinds);
    edge.damping = 0.5 * random_int(0, 2);
    edge.break_threshold = test::coin() ? kUnbreakable : test::uniform(0.001, 0.1);
    edge.crush_threshold = test::coin() ? kUnbreakable : test::uniform(0.001, 0.1);
  }
}

RC_GTEST_PROP(RegularGridProperty, SpringsJoinTheCellsTheySay, ()) {
  PhysicalModel model = random_voxels(1, 0.01 * random_int(10, 101));
  set_random_constants(model, random_int(1, 12));
  for (int i = random_int(0, 10); i > 0; --i) {
    const auto e = EdgeId(std::size_t(random_int(0, static_cast<int>(model.edges.size()))));
    model.edges[e].rest_length *= test::uniform(0.9, 1.1);
  }
  const auto grids = regular_grids(model);
  RC_CLASSIFY(!grids.empty(), "with grids");
  RC_ASSERT(complaints(model, grids).empty());
}

std::map<std::int32_t, std::size_t> grid_of_points(const std::vector<RegularGrid>& grids) {
  std::map<std::int32_t, std::size_t> grid_of;
  for (std::size_t g = 0; g < grids.size(); ++g)
    for (std::int32_t p : grids[g].point)
      if (p >= 0) grid_of[p] = g;
  return grid_of;
}

// With no more classes than there is room for, nothing between two points of a grid is left out.
RC_GTEST_PROP(RegularGridProperty, HasAllEdgesBetweenItsPoints, ()) {
  PhysicalModel model = random_voxels(3, 0.01 * random_int(30, 101));
  set_random_constants(model, 7);
  const auto grids = regular_grids(model);
  const auto grid_of = grid_of_points(grids);
  std::size_t expected = 0;
  for (const Edge& edge : model.geometry.edges) {
    const auto a = grid_of.find(edge.a.value), b = grid_of.find(edge.b.value);
    expected += a != grid_of.end() && b != grid_of.end() && a->second == b->second;
  }
  RC_CLASSIFY(!grids.empty(), "with grids");
  RC_ASSERT(springs_in(grids) == expected);
  RC_ASSERT(complaints(model, grids).empty());
}

// As above, and all cells are there: one piece, whose grid is worth it.
RC_GTEST_PROP(RegularGridProperty, LeavesNothingOutOfADenseModel, ()) {
  PhysicalModel model = random_voxels(4, 1.0);
  set_random_constants(model, 7);
  const auto grids = regular_grids(model);
  RC_ASSERT(springs_in(grids) == model.edges.size());
}

}  // namespace
}  // namespace limber
