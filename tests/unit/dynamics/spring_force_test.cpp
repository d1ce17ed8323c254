#include "core/dynamics/spring_force.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kStiffness = 250.0, kDamping = 3.0, kRest = 0.8;

double energy_at(const Vec3& d) {
  return spring_energy(kStiffness, spring_stretch(d, Vec3::Zero(), kRest).stretch);
}

TEST(SpringForce, PullsWhenStretchedAndPushesWhenCompressed) {
  const Vec3 still = Vec3::Zero();
  const SpringStretch longer = spring_stretch({1.0, 0.0, 0.0}, still, kRest);
  EXPECT_NEAR(spring_tension(kStiffness, 0.0, longer.stretch, longer.rate), 50.0, 1e-12);
  const SpringStretch shorter = spring_stretch({0.0, 0.0, -0.5}, still, kRest);
  EXPECT_NEAR(spring_tension(kStiffness, 0.0, shorter.stretch, shorter.rate), -75.0, 1e-12);
  EXPECT_EQ(shorter.direction, Vec3(0.0, 0.0, -1.0));
}

// E depends on d = x_b - x_a, so that the force on a is -dE/dx_a = dE/dd, and it has to be +T n.
TEST(SpringForce, OnTheFirstPointIsTheGradientOfTheEnergy) {
  constexpr double kStep = 1e-6;
  std::mt19937 random(1);
  for (int n = 0; n < 50; ++n) {
    const Vec3 d = test::random_vector(random, 1.5);
    const SpringStretch state = spring_stretch(d, Vec3::Zero(), kRest);
    const Vec3 force = spring_tension(kStiffness, 0.0, state.stretch, 0.0) * state.direction;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 h = kStep * Vec3::Unit(axis);
      EXPECT_NEAR(force[axis], (energy_at(d + h) - energy_at(d - h)) / (2.0 * kStep), 1e-6);
    }
  }
}

TEST(SpringForce, RateIsTheDerivativeOfTheLength) {
  constexpr double kStep = 1e-6;
  std::mt19937 random(2);
  for (int n = 0; n < 50; ++n) {
    const Vec3 d = Vec3(1.0, 0.0, 0.0) + test::random_vector(random, 0.5);
    const Vec3 w = test::random_vector(random, 2.0);
    const double difference = ((d + kStep * w).norm() - (d - kStep * w).norm()) / (2.0 * kStep);
    EXPECT_NEAR(spring_stretch(d, w, kRest).rate, difference, 1e-8);
  }
}

TEST(SpringForce, DampingOpposesTheRateAndActsAlongTheEdgeOnly) {
  const Vec3 d(kRest, 0.0, 0.0);
  const SpringStretch state = spring_stretch(d, {2.0, 5.0, -7.0}, kRest);
  // c dL/dt = 3 N s/m * 2 m/s. Separating points are pulled together.
  EXPECT_NEAR(spring_tension(kStiffness, kDamping, state.stretch, state.rate), 6.0, 1e-12);
  EXPECT_EQ(state.direction, Vec3::UnitX());
}

TEST(SpringForce, RigidRotationIsNotDamped) {
  std::mt19937 random(3);
  for (int n = 0; n < 50; ++n) {
    const Vec3 d = test::random_vector(random, 1.0), omega = test::random_vector(random, 10.0);
    EXPECT_NEAR(spring_stretch(d, omega.cross(d), kRest).rate, 0.0, 1e-13);
  }
}

TEST(SpringForce, OfCoincidentPointsIsZero) {
  const SpringStretch state = spring_stretch(Vec3::Zero(), {1.0, 2.0, 3.0}, kRest);
  const double tension = spring_tension(kStiffness, kDamping, state.stretch, state.rate);
  EXPECT_EQ(tension, -kStiffness * kRest);  // finite, and without a direction no force
  EXPECT_EQ(Vec3(tension * state.direction), Vec3::Zero());
}

}  // namespace
}  // namespace limber
