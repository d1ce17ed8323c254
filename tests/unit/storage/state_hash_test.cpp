#include "core/storage/state_hash.h"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

namespace limber {
namespace {

std::uint64_t hash_of(const std::vector<double>& values) {
  StateHash hash;
  hash.add(std::span<const double>(values));
  return hash.value();
}

double with_bit_flipped(double value, int bit) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ (std::uint64_t{1} << bit));
}

TEST(StateHash, IsEqualForEqualBits) {
  EXPECT_EQ(hash_of({1.0, -2.5, 1e-300}), hash_of({1.0, -2.5, 1e-300}));
}

TEST(StateHash, DiffersByAnyOneBit) {
  const std::vector<double> values = {1.0, -2.5, 1e-300};
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (int bit = 0; bit < 64; ++bit) {
      std::vector<double> other = values;
      other[i] = with_bit_flipped(other[i], bit);
      EXPECT_NE(hash_of(other), hash_of(values)) << "value " << i << ", bit " << bit;
    }
  }
}

TEST(StateHash, TellsZeroFromMinusZeroAndOrders) {
  EXPECT_NE(hash_of({0.0}), hash_of({-0.0}));
  EXPECT_NE(hash_of({1.0, 2.0}), hash_of({2.0, 1.0}));
  EXPECT_NE(hash_of({}), hash_of({0.0}));
}

TEST(StateHash, DependsOnTheBytesNotOnHowTheyAreHandedOver) {
  StateHash hash;
  hash.add(1.0);
  hash.add(std::span<const double>(std::vector<double>{2.0, 3.0}));
  EXPECT_EQ(hash.value(), hash_of({1.0, 2.0, 3.0}));
  EXPECT_EQ(hash.value(), hash.value());  // asking changes nothing
}

// XXH3 of no bytes, from the specification's test vectors (xxhash 0.8, seed 0).
TEST(StateHash, OfNothingIsXxh3OfNothing) { EXPECT_EQ(hash_of({}), 0x2d06800538d394c2u); }

}  // namespace
}  // namespace limber
