#include <gtest/gtest.h>

#include <cmath>

#include "core/contact/penalty.h"

// The law that is softer near the surface than below.

namespace limber {
namespace {

constexpr double kMass = 3.0;       // kg
constexpr double kSoftDepth = 0.2;  // m

PenaltyContact stiffening(double deep_frequency) {
  return {.frequency = 10.0,
          .restitution = 0.5,
          .soft_depth = kSoftDepth,
          .deep_frequency = deep_frequency};
}

// By hand: 3 kg * (100 / s^2 * 0.2 m + 2500 / s^2 * 0.1 m) = 810 N; 6 J + (60 + 810) / 2 N * 0.1 m.
TEST(SoftDepth, IsWhatItIsByHand) {
  const PenaltyContact law = stiffening(50.0);
  EXPECT_NEAR(law.elastic_force(kMass, 0.3), 810.0, 1e-12 * 810.0);
  EXPECT_NEAR(law.elastic_energy(kMass, 0.3), 49.5, 1e-12 * 49.5);
  EXPECT_NEAR(law.elastic_energy(kMass, kSoftDepth), 6.0, 1e-12 * 6.0);
}

// Central differences are exact for parabolas: what differs is rounding, eps E / h.
TEST(SoftDepth, ForceIsTheSlopeOfTheEnergy) {
  constexpr double kDifference = 1e-4;  // m
  for (double deep : {10.0, 50.0, 500.0}) {
    const PenaltyContact law = stiffening(deep);
    for (double depth : {0.001, 0.1, 0.1998, 0.2002, 0.3, 2.0}) {
      const double slope = (law.elastic_energy(kMass, depth + kDifference) -
                            law.elastic_energy(kMass, depth - kDifference)) /
                           (2.0 * kDifference);
      const double rounding = 1e-15 * law.elastic_energy(kMass, depth + kDifference) / kDifference;
      EXPECT_NEAR(law.elastic_force(kMass, depth), slope, 4.0 * rounding) << depth << ", " << deep;
    }
  }
}

TEST(SoftDepth, EnergyAndForceDoNotJumpWhereItEnds) {
  const PenaltyContact law = stiffening(500.0);
  const double above = std::nextafter(kSoftDepth, 1.0);
  const double ulp = above - kSoftDepth;
  EXPECT_NEAR(law.elastic_force(kMass, above), law.elastic_force(kMass, kSoftDepth),
              2.0 * kMass * 500.0 * 500.0 * ulp);
  EXPECT_NEAR(law.elastic_energy(kMass, above), law.elastic_energy(kMass, kSoftDepth),
              2.0 * law.elastic_force(kMass, kSoftDepth) * ulp);
}

TEST(SoftDepth, DeeperIsHarder) {
  for (double deep : {1.0, 10.0, 500.0}) {
    const PenaltyContact law = stiffening(deep);
    EXPECT_EQ(law.elastic_force(kMass, 0.0), 0.0);
    EXPECT_EQ(law.elastic_energy(kMass, 0.0), 0.0);
    for (int i = 0; i < 1000; ++i) {
      const double depth = 5e-4 * i, deeper = depth + 5e-4;
      EXPECT_LT(law.elastic_force(kMass, depth), law.elastic_force(kMass, deeper));
      EXPECT_LT(law.elastic_energy(kMass, depth), law.elastic_energy(kMass, deeper));
    }
  }
}

TEST(SoftDepth, WithoutOneTheLawIsASpring) {
  const PenaltyContact law{.frequency = 10.0};
  EXPECT_DOUBLE_EQ(law.elastic_force(kMass, 7.0), 2100.0);
  EXPECT_DOUBLE_EQ(law.elastic_energy(kMass, 7.0), 7350.0);
}

// Below it as well the way out gives e^2 of what the way in took.
TEST(SoftDepth, KeepsTheRestitution) {
  const PenaltyContact law = stiffening(50.0);
  for (double depth : {0.1, 0.3, 1.0}) {
    const double in = penalty_force(law, kMass, depth, -1.0);
    EXPECT_DOUBLE_EQ(in, law.elastic_force(kMass, depth));
    EXPECT_DOUBLE_EQ(penalty_force(law, kMass, depth, 1.0), 0.25 * in);
  }
}

}  // namespace
}  // namespace limber
