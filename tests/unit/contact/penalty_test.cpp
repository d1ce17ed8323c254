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

TEST(Penalty, DampingRatioGivesTheRestitutionOfASpringWithDashpot) {
  for (double e : {0.05, 0.2, 0.5, 0.9, 1.0}) {
    const double zeta = damping_ratio_of_restitution(e);
    const double found =
        rebound([&](double depth, double speed) { return depth - 2.0 * zeta * speed; });
    EXPECT_NEAR(found, e, 2e-3) << "restitution " << e;  // the last step overshoots
  }
}

// Without adhesion the contact ends when the force does, with some overlap left, and rebounds
// faster: e' = exp(-zeta / s (pi - atan2(2 zeta s, 1 - 2 zeta^2))), s = sqrt(1 - zeta^2)
// (Schwager and Poeschel, Granular Matter 9, 2007).
TEST(Penalty, ForceWithoutAdhesionReboundsAsSchwagerAndPoeschelFound) {
  for (double zeta : {0.0, 0.1, 0.3, 0.69}) {
    const PenaltyContact law{.frequency = 1.0, .damping_ratio = zeta};
    const double found =
        rebound([&](double depth, double speed) { return penalty_force(law, 1.0, depth, speed); });
    const double s = std::sqrt(1.0 - zeta * zeta);
    const double wanted =
        std::exp(-zeta / s * (M_PI - std::atan2(2.0 * zeta * s, 1.0 - 2.0 * zeta * zeta)));
    EXPECT_NEAR(found, wanted, 2e-3) << "zeta " << zeta;
  }
}

TEST(Penalty, RestitutionBelowATwentiethCountsAsATwentieth) {
  EXPECT_EQ(damping_ratio_of_restitution(0.0), damping_ratio_of_restitution(0.05));
  EXPECT_EQ(damping_ratio_of_restitution(1.0), 0.0);
  EXPECT_NEAR(damping_ratio_of_restitution(0.0), 0.69, 0.005);
}

// k = omega^2 m = 100 * 3, c = 2 zeta omega m = 0.5 * 10 * 2 * 3.
TEST(Penalty, StiffnessAndDampingFollowTheReducedMass) {
  const PenaltyContact law{.frequency = 10.0, .damping_ratio = 0.5};
  EXPECT_DOUBLE_EQ(penalty_force(law, 3.0, 0.1, 0.0), 30.0);
  EXPECT_DOUBLE_EQ(penalty_force(law, 3.0, 0.0, -2.0), 60.0);  // approaching points are stopped
  EXPECT_DOUBLE_EQ(penalty_force(law, 3.0, 0.1, 0.5), 15.0);
  EXPECT_EQ(penalty_force(law, 3.0, 0.1, 2.0), 0.0);  // never pulls
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
