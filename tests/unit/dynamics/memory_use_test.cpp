#include "core/dynamics/memory_use.h"

#include <gtest/gtest.h>

#include "core/modeller/cubic_lattice.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

MemoryUse use_of(const PhysicalModel& model) { return memory_use(test::lattice_of({model})); }

TEST(MemoryUse, GrowsWithWhatAnObjectHas) {
  const MemoryUse rope = use_of(test::chain({.points = 8}));
  const MemoryUse longer = use_of(test::chain({.points = 16}));
  EXPECT_EQ(longer.points, 2 * rope.points);
  // A rope has neither cells nor faces: what breaking keeps of it is its edges alone.
  EXPECT_LT(rope.breaking, 32u * 7u);
  const MemoryUse block =
      use_of(cubic_lattice({.points = {2, 2, 2}, .springs = {.axial = 100.0}}));
  EXPECT_EQ(block.points, rope.points);
  EXPECT_GT(block.breaking, rope.breaking);
  EXPECT_EQ(block.total(), block.points + block.springs + block.breaking + block.authored);
}

TEST(MemoryUse, OfNothingIsNearlyNothing) { EXPECT_LT(memory_use(Lattice{}).total(), 64u); }

}  // namespace
}  // namespace limber
