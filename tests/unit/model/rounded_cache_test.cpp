#include "core/model/rounded_cache.h"

#include <gtest/gtest.h>

#include "core/modeller/box_lattice.h"
#include "core/modeller/cell_stiffness.h"

namespace limber {
namespace {

RoundedKey key_of(double value, double quantum) {
  RoundedKey key;
  key.add(value, quantum);
  return key;
}

TEST(RoundedKey, IsTheSameForWhatDiffersByRounding) {
  const double quantum = RoundedKey::quantum(0.1);
  EXPECT_EQ(key_of(0.1, quantum), key_of(1.1 - 1.0, quantum));
  EXPECT_FALSE(key_of(0.1, quantum) == key_of(0.1 * (1 + 1e-10), quantum));
  EXPECT_FALSE(key_of(0.1, quantum) == key_of(-0.1, quantum));
  EXPECT_LT(quantum / 0.1, 2e-12);
}

// What the modeller's speed rests on: 8000 cells, hardly a shape, 5 m off the origin.
TEST(RoundedCache, HasFewKindsOfCellsForARegularLattice) {
  const GeometricModel g =
      box_lattice({20, 20, 20}, {0.011, 0.007, 0.013}, {5.1, -3.3, 0.7}, "box");
  RoundedCache<int> cache;
  RoundedKey key;
  std::vector<Vec3> vectors;
  int computed = 0;
  for (const Cell& cell : g.cells) {
    vectors.clear();
    for (EdgeId e : cell.edges) vectors.push_back(g.points[g.edges[e].b] - g.points[g.edges[e].a]);
    set_shape_key(vectors, key);
    cache.get(key, [&] { return ++computed; });
  }
  EXPECT_LE(computed, 8);
  EXPECT_EQ(static_cast<int>(cache.kinds()), computed);
}

TEST(RoundedCache, DoesNotGrowForEver) {
  RoundedCache<int> cache;
  for (int i = 0; i < 10000; ++i) {
    EXPECT_EQ(cache.get(key_of(i, 1.0), [&] { return i; }), i);
    EXPECT_EQ(cache.get(key_of(i, 1.0), [&] { return -1; }), i);
  }
  EXPECT_LE(cache.kinds(), 4096u);
}

}  // namespace
}  // namespace limber
