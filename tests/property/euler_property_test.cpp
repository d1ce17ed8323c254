#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "core/operators/boundary_operator.h"
#include "core/operators/breaking_operator.h"
#include "tests/property/generators.h"
#include "tests/support/blocks.h"
#include "tests/support/measure.h"

// Euler characteristics of what is left of a block after any breaks, counted on the cubes alone:
// which of them are there, without edges, faces or their reverses.

namespace limber {
namespace {

using Place = std::array<int, 3>;

struct Cubes {
  Place size;               // cells per axis
  std::vector<bool> whole;  // x fastest

  bool at(int x, int y, int z) const {
    if (x < 0 || y < 0 || z < 0 || x >= size[0] || y >= size[1] || z >= size[2]) return false;
    return whole[static_cast<std::size_t>(x + size[0] * (y + size[1] * z))];
  }
};

Cubes cubes_of(const PhysicalModel& m, const test::BlockShape& shape) {
  Cubes cubes{shape.cells, {}};
  for (const CellAttributes& cell : m.cells) cubes.whole.push_back(cell.valid);
  return cubes;
}

// A vertex, edge, square or cube of the grid, named by its middle on a grid of half the spacing:
// odd along the axes that it extends along.
int dimension_of(const Place& middle) {
  return (middle[0] & 1) + (middle[1] & 1) + (middle[2] & 1);
}

// How many of the cubes around it are there, and how many there could be.
std::array<int, 2> cubes_around(const Cubes& cubes, const Place& middle) {
  std::array<int, 2> count = {0, 0};
  for (int corner = 0; corner < 8; ++corner) {
    Place cube;
    bool distinct = true;
    for (int axis = 0; axis < 3; ++axis) {
      const int side = corner >> axis & 1;
      distinct &= !(middle[axis] & 1 && side);
      cube[axis] = (middle[axis] & 1) ? middle[axis] / 2 : middle[axis] / 2 - side;
    }
    if (!distinct) continue;
    count[0] += cubes.at(cube[0], cube[1], cube[2]);
    ++count[1];
  }
  return count;
}

struct EulerNumbers {
  int solid = 0;    // vertices - edges + squares - cubes
  int surface = 0;  // vertices - edges + squares
};

// A vertex or edge is part of the surface when some but not all cubes around it are there; so is a
// square with one of two. The two triangles of a square add one edge and one face: nothing.
EulerNumbers euler_numbers(const Cubes& cubes) {
  EulerNumbers sum;
  for (int z = 0; z <= 2 * cubes.size[2]; ++z)
    for (int y = 0; y <= 2 * cubes.size[1]; ++y)
      for (int x = 0; x <= 2 * cubes.size[0]; ++x) {
        const auto [there, all] = cubes_around(cubes, {x, y, z});
        const int sign = dimension_of({x, y, z}) % 2 == 0 ? 1 : -1;
        if (there > 0) sum.solid += sign;
        if (there > 0 && there < all) sum.surface += sign;
      }
  return sum;
}

// Do the cubes around the vertex that are there (or that are not) hang together by squares?
bool hang_together(const Cubes& cubes, const Place& vertex, bool there) {
  std::set<int> left;
  for (int i = 0; i < 8; ++i)
    if (cubes.at(vertex[0] - (i & 1), vertex[1] - (i >> 1 & 1), vertex[2] - (i >> 2 & 1)) == there)
      left.insert(i);
  if (left.empty()) return true;
  std::vector<int> reached = {*left.begin()};
  left.erase(left.begin());
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (int bit : {1, 2, 4})
      if (left.erase(reached[k] ^ bit)) reached.push_back(reached[k] ^ bit);
  return left.empty();
}

// No two cubes touch in an edge or a corner alone.
bool is_manifold(const Cubes& cubes) {
  for (int z = 0; z <= cubes.size[2]; ++z)
    for (int y = 0; y <= cubes.size[1]; ++y)
      for (int x = 0; x <= cubes.size[0]; ++x)
        if (!hang_together(cubes, {x, y, z}, true) || !hang_together(cubes, {x, y, z}, false))
          return false;
  return true;
}

RC_GTEST_PROP(EulerProperty, BoundaryAndSolidAreThoseOfTheCubesLeft, ()) {
  const test::BlockShape shape = test::random_shape(4);
  PhysicalModel m = test::block(shape);
  break_edges(m, test::ids(test::random_edges(m)));
  const EulerNumbers cubes = euler_numbers(cubes_of(m, shape));
  const std::map<std::string, int> counts = test::topology_counts(m);
  RC_ASSERT(counts.at("boundary_euler_V_E_F") == cubes.surface);
  RC_ASSERT(counts.at("solid_euler") == cubes.solid);
}

// The surface of a solid without pinches is a closed manifold: twice the Euler characteristic of
// what it encloses, 2 for each ball, 0 for a ring, 4 for a shell around a hollow.
RC_GTEST_PROP(EulerProperty, SurfaceHasTwiceTheNumberOfTheSolid, ()) {
  const test::BlockShape shape = test::random_shape(5);
  PhysicalModel m = test::block(shape);
  const std::vector<std::int32_t> edges = test::random_edges(m);
  break_edges(m,
              test::ids({edges.begin(), edges.begin() + std::min<std::size_t>(3, edges.size())}));
  const bool manifold = is_manifold(cubes_of(m, shape));
  RC_CLASSIFY(manifold, "manifold");
  const std::map<std::string, int> counts = test::topology_counts(m);
  RC_ASSERT(!manifold || counts.at("boundary_nonmanifold_edges") == 0);
  RC_ASSERT(!manifold || counts.at("boundary_euler_V_E_F") == 2 * counts.at("solid_euler"));
}

// A ring and a hollow, which few random breaks leave behind.
TEST(EulerNumbers, OfARingAndAHollow) {
  const test::BlockShape ring{.cells = {3, 3, 1}}, hollow{.cells = {3, 3, 3}};
  PhysicalModel m = test::block(ring);
  m.cells[CellId(4)].valid = false;  // the middle alone, as no breaking would: counts only
  EXPECT_EQ(test::topology_counts(m).at("boundary_euler_V_E_F"), 0);
  EXPECT_EQ(euler_numbers(cubes_of(m, ring)).surface, 0);
  m = test::block(hollow);
  m.cells[CellId(13)].valid = false;
  EXPECT_EQ(test::topology_counts(m).at("boundary_euler_V_E_F"), 4);
  EXPECT_EQ(euler_numbers(cubes_of(m, hollow)).surface, 4);
  EXPECT_TRUE(is_manifold(cubes_of(m, hollow)));
}

}  // namespace
}  // namespace limber
