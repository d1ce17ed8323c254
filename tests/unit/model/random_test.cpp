#include "core/model/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limber {
namespace {

// The 10000th number of a std::mt19937_64 with its default seed is 9981545732273789042 (the C++
// standard, [rand.predef]).
TEST(Random, IsTheStandardsEngineToTheBit) {
  Random random(std::mt19937_64::default_seed);
  for (int i = 1; i < 10000; ++i) random.uniform();
  EXPECT_EQ(random.uniform(), std::ldexp(static_cast<double>(9981545732273789042u >> 11), -53));
}

// Mean 1/2 and variance 1/12 of n numbers, each within five standard errors: sqrt(1 / (12 n)) and
// sqrt(1 / (180 n)).
TEST(Random, IsUniformBetweenNoughtAndOne) {
  constexpr int n = 100'000;
  Random random(1);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u - 0.5;
    squares += (u - 0.5) * (u - 0.5);
  }
  EXPECT_NEAR(sum / n, 0.0, 5.0 * std::sqrt(1.0 / (12.0 * n)));
  EXPECT_NEAR(squares / n, 1.0 / 12.0, 5.0 * std::sqrt(1.0 / (180.0 * n)));
}

TEST(Random, FillsABox) {
  const Box3 box(Vec3(-1.0, 2.0, 10.0), Vec3(1.0, 2.5, 14.0));
  Random random(7);
  Box3 hit;
  for (int i = 0; i < 10'000; ++i) hit.extend(random.in_box(box));
  EXPECT_TRUE(box.contains(hit));
  EXPECT_LT(((box.sizes() - hit.sizes()).array() / box.sizes().array()).maxCoeff(), 0.002);
}

TEST(Random, DependsOnItsSeed) {
  Random a(1), b(2), again(1);
  const double first = a.in(-3.0, 5.0);
  EXPECT_NE(first, b.in(-3.0, 5.0));
  EXPECT_EQ(first, again.in(-3.0, 5.0));
}

}  // namespace
}  // namespace limber
