#include <gtest/gtest.h>

#include <cmath>

#include "core/environment/flow_field.h"

namespace limber {
namespace {

struct Pole {
  int p, q;
};
constexpr Pole kPoles[] = {{1, 1}, {2, 1}, {2, 2}, {3, 2}};  // of the primitives

TEST(RegularisedPole, IsExactOutsideAndSmoothAtTheCoreRadius) {
  constexpr double R = 0.3, h = 1e-6;
  for (const auto& [p, q] : kPoles) {
    const auto f = [p = p, q = q](double r) { return regularised_pole(r, R, p, q); };
    EXPECT_DOUBLE_EQ(f(1.7), std::pow(1.7, -p));
    const double pole = std::pow(R, -p), slope = -p * pole / R;
    EXPECT_NEAR(f(R), pole, 1e-14 * pole);
    EXPECT_NEAR((f(R) - f(R - h)) / h, slope, 1e-4 * pole / R);
    EXPECT_NEAR((f(R + h) - f(R)) / h, slope, 1e-4 * pole / R);
  }
}

TEST(RegularisedPole, FallsToZeroInsideAndIsBounded) {
  constexpr double R = 0.3;
  for (const auto& [p, q] : kPoles) {
    const double pole = std::pow(R, -p);
    EXPECT_EQ(regularised_pole(0.0, R, p, q), 0.0);
    // The next term is smaller by s^2.
    const double s = 1e-4, leading = std::pow(s, q) * (1.0 + 0.5 * (p + q)) * pole;
    EXPECT_NEAR(regularised_pole(s * R, R, p, q), leading, 1e-7 * leading);
    for (int i = 0; i <= 1000; ++i) {
      const double f = regularised_pole(1e-3 * i * R, R, p, q);
      EXPECT_GE(f, 0.0);
      EXPECT_LE(f, 1.25 * pole);
    }
  }
}

}  // namespace
}  // namespace limber
