#include "core/contact/penalty.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limber {
namespace {

// Speed of rebound per speed of approach of a unit mass and a unit spring with the given force law,
// by the classical Runge-Kutta method. `force(depth, separation_speed)`; the contact ends when the
// overlap does.
template <class Force>
double rebound(Force force) {
  constexpr double kStep = 1e-3;
  double depth = 0.0, rate = 1.0;  // rate of the depth: minus the separation speed
  const auto acceleration = [&](double x, double v) { return -force(x, -v); };
  do {
    const double k1 = acceleration(depth, rate);
    const double v2 = rate + 0.5 * kStep * k1;
    const double k2 = acceleration(depth + 0.5 * kStep * rate, v2);
    const double v3 = rate + 0.5 * kStep * k2;
    const double k3 = acceleration(depth + 0.5 * kStep * v2, v3);
    const double v4 = rate + kStep * k3;
    const double k4 = acceleration(depth + kStep * v3, v4);
    depth += kStep / 6.0 * (rate + 2.0 * v2 + 2.0 * v3 + v4);
    rate += kStep / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  } while (depth > 0.0);
  return -rate;
}

TEST(Penalty, ReboundsWithItsRestitution) {
  for (double e : {0.1, 0.2, 0.5, 0.9, 1.0}) {
    const PenaltyContact law{.frequency = 1.0, .restitution = e};
    const double found =
        rebound([&](double depth, double speed) { return penalty_force(law, 1.0, depth, speed); });
    EXPECT_NEAR(found, e, 2e-3) << "restitution " << e;  // the last step overshoots
  }
}

// What a dashpot made for the point's mass cannot do.
TEST(Penalty, ReboundsAlikeWithAHundredTimesTheMassBehindThePoint) {
  const PenaltyContact law{.frequency = 1.0, .restitution = 0.5};
  const double found = rebound(
      [&](double depth, double speed) { return penalty_force(law, 1.0, depth, speed) / 100.0; });
  EXPECT_NEAR(found, 0.5, 2e-3);
}

TEST(Penalty, RestitutionBelowATenthCountsAsATenth) {
  const PenaltyContact none{.frequency = 10.0, .restitution = 0.0};
  const PenaltyContact tenth{.frequency = 10.0, .restitution = 0.1};
  EXPECT_GT(penalty_force(none, 1.0, 0.1, 1.0), 0.0);
  EXPECT_EQ(penalty_force(none, 1.0, 0.1, 1.0), penalty_force(tenth, 1.0, 0.1, 1.0));
}

// k = omega^2 m = 100 * 3.
TEST(Penalty, StiffnessFollowsTheReducedMass) {
  const PenaltyContact law{.frequency = 10.0, .restitution = 0.5};
  EXPECT_DOUBLE_EQ(penalty_force(law, 3.0, 0.1, 0.0), 30.0);
  EXPECT_DOUBLE_EQ(penalty_force(law, 3.0, 0.1, -2.0), 30.0);
  EXPECT_DOUBLE_EQ(penalty_force(law, 3.0, 0.1, 2.0), 7.5);  // a quarter when separating
  EXPECT_EQ(penalty_force(law, 3.0, -0.1, -2.0), 0.0);       // never pulls
}

TEST(Penalty, FrictionOpposesTheSlipAndIsBoundedByMuN) {
  const Vec3 slip(3.0, 0.0, 4.0);
  const Vec3 sliding = friction_force(0.5, 10.0, 2.0, slip, 1e-4);
  EXPECT_LE((sliding - Vec3(-3.0, 0.0, -4.0)).norm(), 1e-14);  // 5 N against 5 m/s
  EXPECT_EQ(friction_force(0.5, 10.0, 2.0, Vec3::Zero(), 1e-4), Vec3::Zero());
  EXPECT_EQ(friction_force(0.0, 10.0, 2.0, slip, 1e-4), Vec3(-0.0 * slip));
}

TEST(Penalty, FrictionNeverReversesTheSlip) {
  constexpr double kMass = 2.0;
  for (double dt : {1e-6, 1e-3, 1.0}) {
    for (double normal : {0.0, 1.0, 1e9}) {
      const Vec3 slip(0.3, -0.1, 0.2);
      const Vec3 force = friction_force(0.8, normal, kMass, slip, dt);
      const Vec3 after = slip + force * (dt / kMass);
      EXPECT_GE(after.dot(slip), 0.0);
      EXPECT_LE(after.norm(), slip.norm());
      EXPECT_LE(force.norm(), 0.8 * normal * (1.0 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace limber
