#include "core/dynamics/free_rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace limber {
namespace {

TEST(Turned, ByAQuarterOfATurnPerSecondIsAQuarter) {
  const Eigen::Quaterniond q =
      turned(Eigen::Quaterniond::Identity(), 0.5 * std::numbers::pi * Vec3::UnitZ(), 1.0);
  EXPECT_LT((q * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
}

TEST(Turned, ByNothingIsTheSame) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
  EXPECT_EQ(turned(q, Vec3::Zero(), 1.0).coeffs(), q.coeffs());
}

// In the world frame: dR/dt r = omega x R r.
TEST(Turned, TurnsAboutAnAxisOfTheWorld) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, 3.0).normalized()));
  const Vec3 omega(0.3, -2.0, 1.0), arm(0.4, 0.5, -0.6);
  constexpr double kStep = 1e-6;
  const Vec3 numeric =
      (turned(q, omega, kStep) * arm - turned(q, omega, -kStep) * arm) / (2.0 * kStep);
  EXPECT_LT((numeric - omega.cross(q * arm)).norm(), 1e-9);
}

// A symmetric top precesses about L at L / I_1 (Goldstein, Classical Mechanics, 5.6).
TEST(RotateFreely, LetsASymmetricTopPrecessInClosedForm) {
  const Vec3 moments(2.0, 2.0, 1.0);
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  const Vec3 start(1.5, 0.0, 6.0);
  Vec3 omega = start;
  constexpr double kSeconds = 0.5;
  for (int tick = 0; tick < 30; ++tick) rotate_freely(q, omega, moments, kSeconds / 30);
  const Vec3 momentum = moments.cwiseProduct(start);
  // Body axis 3 about L, and the body about its axis by omega_3 (1 - I_3 / I_1) ... seen from
  // there.
  const double precession = momentum.norm() / moments.x();
  const double own_spin = start.z() - momentum.z() / moments.x();
  const Eigen::Quaterniond exact =
      Eigen::AngleAxisd(precession * kSeconds, momentum.normalized()) *
      Eigen::Quaterniond(Eigen::AngleAxisd(own_spin * kSeconds, Vec3::UnitZ()));
  EXPECT_LT(q.angularDistance(exact), 1e-8);
}

TEST(RotateFreely, KeepsAngularMomentumAndNearlyEnergy) {
  const Vec3 moments(1.0, 2.0, 3.0);
  Eigen::Quaterniond q(Eigen::AngleAxisd(0.4, Vec3(1.0, 1.0, 0.0).normalized()));
  Vec3 omega(3.0, 8.0, 1.0);
  const auto momentum = [&] { return Vec3(q * moments.cwiseProduct(q.conjugate() * omega)); };
  const Vec3 before = momentum();
  const double energy = 0.5 * omega.dot(before);
  for (int tick = 0; tick < 300; ++tick) rotate_freely(q, omega, moments, 1.0 / 60.0);
  EXPECT_LT((momentum() - before).norm(), 1e-11 * before.norm());
  EXPECT_NEAR(0.5 * omega.dot(momentum()), energy, 1e-7 * energy);
}

// About the intermediate axis, where small errors grow fastest. Errors of steps near the largest
// turn fall with the fourth power of the step.
TEST(RotateFreely, IsOfFourthOrder) {
  const Vec3 moments(1.0, 2.0, 3.0);
  const auto after_a_second = [&](int steps) {
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    Vec3 omega(0.5, 5.0, 0.3);
    for (int i = 0; i < steps; ++i) rotate_freely(q, omega, moments, 1.0 / steps);
    return q;
  };
  const Eigen::Quaterniond exact = after_a_second(20000);
  const double error = after_a_second(150).angularDistance(exact);
  const double of_halves = after_a_second(300).angularDistance(exact);
  EXPECT_LT(error, 1e-7);
  EXPECT_NEAR(std::log2(error / of_halves), 4.0, 0.3);
}

// What turns faster than anything does is not followed any more; that it does not take for ever,
// and keeps its angular momentum, is what is left.
TEST(RotateFreely, EndsAtAnySpeed) {
  const Vec3 moments(1.0, 2.0, 3.0);
  const auto momentum_of = [&](const Eigen::Quaterniond& q, const Vec3& omega) {
    return Vec3(q * moments.cwiseProduct(q.conjugate() * omega));
  };
  for (double speed : {1e6, 1e12, 1e100}) {
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    Vec3 omega = speed * Vec3(0.5, 5.0, 0.3);
    const Vec3 before = momentum_of(q, omega);
    rotate_freely(q, omega, moments, 1.0);
    EXPECT_LT((momentum_of(q, omega) - before).norm(), 1e-9 * before.norm()) << speed;
  }
  for (double speed :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    Vec3 omega = Vec3::Constant(speed);
    rotate_freely(q, omega, moments, 1.0);  // whatever comes of it
  }
}

TEST(RotateFreely, BackwardsIsTheWayBack) {
  const Vec3 moments(1.0, 2.0, 3.0);
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Vec3 omega(0.5, 5.0, 0.3);
  rotate_freely(q, omega, moments, 0.5);
  rotate_freely(q, omega, moments, -0.5);
  EXPECT_LT(q.angularDistance(Eigen::Quaterniond::Identity()), 1e-7);
}

}  // namespace
}  // namespace limber
