#include "core/dynamics/live_springs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/lattices.h"

namespace limber {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Points 0 to 4, a metre apart; spring i joins i and i + 1.
Lattice line() { return test::lattice_of({test::chain({.points = 5})}); }

std::vector<std::int32_t> visited(const Lattice& lattice, const std::vector<std::int32_t>& points) {
  std::vector<std::int32_t> at;
  for_each_live_spring(lattice, points, [&](const Spring& s) { at.push_back(s.a); });
  return at;
}

TEST(LiveSprings, AreVisitedOnceInTheOrderOfTheirPoints) {
  const Lattice lattice = line();
  EXPECT_THAT(visited(lattice, {0, 1, 2, 3, 4}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(visited(lattice, {3, 1}), ElementsAre(3, 1));
  EXPECT_THAT(visited(lattice, {4}), IsEmpty());
  EXPECT_THAT(visited(lattice, {}), IsEmpty());
}

TEST(LiveSprings, LeaveOutTheBroken) {
  Lattice lattice = line();
  lattice.breaking.edge_broken[2] = 1;
  EXPECT_THAT(visited(lattice, {0, 1, 2, 3, 4}), ElementsAre(0, 1, 3));
}

TEST(LiveSprings, StretchIsHowMuchLongerOneIs) {
  Lattice lattice = line();
  lattice.motion[1].position = {1.0, 0.75, 0.0};  // 1.25 m from (0, 0, 0)
  EXPECT_DOUBLE_EQ(stretch_of(lattice, lattice.springs[0]), 0.25);
  lattice.motion[4].position = {3.5, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(stretch_of(lattice, lattice.springs[3]), -0.5);
}

}  // namespace
}  // namespace limber
