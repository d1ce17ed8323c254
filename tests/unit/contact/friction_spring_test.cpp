#include "core/contact/friction_spring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr PenaltyContact kLaw{.frequency = 300.0, .friction = 0.5};
constexpr double kMass = 2.0;                                           // kg
constexpr double kNormalForce = 8.0;                                    // N
constexpr double kMost = kLaw.friction * kNormalForce;                  // N
constexpr double kStiffness = kLaw.frequency * kLaw.frequency * kMass;  // N/m
constexpr double kStep = 1e-4;                                          // s
constexpr double kRounding = 1e-14;                                     // of kMost

// A mass on a plane y = 0 under a steady force, by symplectic Euler.
struct Slider {
  Vec3 place = Vec3::Zero(), velocity = Vec3::Zero();

  template <class Friction>
  void run(double seconds, const Vec3& load, Friction friction) {
    for (int n = 0; n < std::lround(seconds / kStep); ++n) {
      velocity += (load + friction(velocity)) * (kStep / kMass);
      place += velocity * kStep;
    }
  }
};

auto pull_of(FrictionSpring& spring) {
  return [&spring](const Vec3& slip) {
    return spring.pull(kLaw, kNormalForce, kMass, Vec3::UnitY(), slip, kStep);
  };
}

TEST(FrictionSpring, OpposesASlipFromRest) {
  for (double speed : {1e-9, 1e-3, 10.0}) {
    FrictionSpring spring;
    const Vec3 slip = speed * Vec3(0.6, 0.0, -0.8);
    const Vec3 force = pull_of(spring)(slip);
    EXPECT_LT(force.dot(slip), 0.0);
    EXPECT_LE(force.cross(slip).norm(), kRounding * force.norm() * speed);
  }
}

// At 1 cm/s the damper reaches mu N at once, at 50 cm/s the spring as well.
TEST(FrictionSpring, PullsWithMuNWhileItSlips) {
  for (double speed : {0.01, 0.5}) {
    FrictionSpring spring;
    const Vec3 slip = speed * Vec3(0.6, 0.0, 0.8);
    for (int n = 0; n < 100; ++n) {
      EXPECT_LE((pull_of(spring)(slip) + kMost * slip.normalized()).norm(), kMost * kRounding)
          << speed << " m/s, substep " << n;
    }
  }
}

TEST(FrictionSpring, IsNothingWithoutFrictionOrNormalForce) {
  FrictionSpring spring;
  const PenaltyContact smooth{.frequency = 300.0};
  EXPECT_EQ(spring.pull(smooth, 8.0, kMass, Vec3::UnitY(), Vec3::UnitX(), kStep).norm(), 0.0);
  EXPECT_EQ(spring.pull(kLaw, 0.0, kMass, Vec3::UnitY(), Vec3::UnitX(), kStep).norm(), 0.0);
}

// Normal, normal force and slip change at random, and the mass falls as the books of a contact let
// it. What has been taken in never is less than what the spring could still give.
TEST(FrictionSpring, GivesBackNoMoreThanItStored) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  FrictionSpring spring;
  double mass = kMass, taken = 0.0, given_back = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const Vec3 normal = (Vec3::UnitY() + test::random_vector(random, 0.3)).normalized();
    const double speed = std::pow(10.0, -4.0 * share(random));
    Vec3 slip = test::random_vector(random, speed);
    slip -= slip.dot(normal) * normal;
    if (n % 100 == 0) mass *= 0.999;
    const double press = kNormalForce * share(random);
    const double work =
        -spring.pull(kLaw, press, mass, normal, slip, kStep).dot(slip) * kStep;  // J, into it
    taken += work;
    if (work < 0.0) given_back -= work;
    const double stored =
        0.5 * kLaw.frequency * kLaw.frequency * mass * spring.stretch.squaredNorm();
    ASSERT_GE(taken, stored) << "substep " << n;
  }
  EXPECT_GT(given_back, 0.0);  // it is a spring, not only a brake
}

// Stretched while it is pressed little and let go while it is pressed hard, over and over: what a
// spring without books would pump energy by.
TEST(FrictionSpring, CannotBePumpedByTheNormalForce) {
  constexpr int kPulls = 50;
  const PenaltyContact law{.frequency = 0.13 / kStep, .friction = kLaw.friction};
  const double k = law.frequency * law.frequency * kMass;
  const double speed = 0.5 * law.friction * kNormalForce / k / (kPulls * kStep);
  FrictionSpring spring;
  spring.pull(law, kNormalForce, kMass, Vec3::UnitY(), Vec3::Zero(), kStep);
  double given = 0.0, most_given = 0.0;  // J, by the contact
  for (int cycle = 0; cycle < 1000; ++cycle) {
    for (int n = 0; n < 2 * kPulls; ++n) {
      const bool stretching = n < kPulls;
      const Vec3 slip = (stretching ? speed : -speed) * Vec3::UnitX();
      const double press = stretching ? 0.01 * kNormalForce : kNormalForce;
      given += spring.pull(law, press, kMass, Vec3::UnitY(), slip, kStep).dot(slip) * kStep;
      most_given = std::max(most_given, given);
    }
  }
  EXPECT_LE(most_given, 1e-3 * kNormalForce * speed * kPulls * kStep);
}

// Where it comes to rest the spring alone bears the load, and nothing moves any more.
TEST(FrictionSpring, HoldsUnderMuNWithoutCreeping) {
  for (double share : {0.1, 0.5, 0.9}) {
    const Vec3 load = share * kMost * Vec3(0.8, 0.0, 0.6);
    FrictionSpring spring;
    Slider slider;
    slider.run(2.0, load, pull_of(spring));
    const Vec3 settled = slider.place;
    slider.run(20.0, load, pull_of(spring));
    EXPECT_LE((slider.place - settled).norm(), kRounding * load.norm() / kStiffness) << share;
    EXPECT_LE((kStiffness * spring.stretch - load).norm(), 1e-12 * load.norm()) << share;
  }
}

// What the spring is there for: the damper alone lets the load go at F dt / (kFrictionShare m).
TEST(FrictionSpring, HoldsWhatFrictionForceAloneLetsCreep) {
  const Vec3 load = 0.5 * kMost * Vec3::UnitX();
  Slider slider;
  slider.run(2.0, load, [](const Vec3& slip) {
    return friction_force(kLaw.friction, kNormalForce, kMass, slip, kStep);
  });
  EXPECT_NEAR(slider.velocity.x(), load.x() * kStep / (kFrictionShare * kMass),
              1e-9 * slider.velocity.x());
}

TEST(FrictionSpring, SlidesUnderMoreThanMuN) {
  const Vec3 load = 1.25 * kMost * Vec3::UnitX();
  FrictionSpring spring;
  Slider slider;
  slider.run(0.1, load, pull_of(spring));
  const double before = slider.velocity.x();
  slider.run(1.0, load, pull_of(spring));
  EXPECT_NEAR(slider.velocity.x() - before, 0.25 * kMost / kMass, 1e-9);
}

TEST(FrictionSpring, TurnsWithTheNormal) {
  std::mt19937 random(5);
  FrictionSpring spring;
  Vec3 normal = Vec3::UnitY();
  for (int n = 0; n < 1000; ++n) {
    normal = (normal + test::random_vector(random, 0.2)).normalized();
    Vec3 slip = test::random_vector(random, 1e-2);
    slip -= slip.dot(normal) * normal;
    const Vec3 force = spring.pull(kLaw, kNormalForce, kMass, normal, slip, kStep);
    ASSERT_LE(std::abs(force.dot(normal)), kMost * kRounding);
    ASSERT_LE(std::abs(spring.stretch.dot(normal)), kRounding * kMost / kStiffness);
  }
}

}  // namespace
}  // namespace limber
