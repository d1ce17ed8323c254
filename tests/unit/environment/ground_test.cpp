#include "core/environment/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limber {
namespace {

using std::numbers::pi;

Ground penalty_ground(double stiffness, double damping, bool adhesive) {
  Ground ground;
  ground.stiffness = stiffness;
  ground.damping = damping;
  ground.adhesive = adhesive;
  return ground;
}

TEST(GroundForce, IsSpringAndDamperBelowTheSurfaceOnly) {
  const Ground ground = penalty_ground(1000.0, 20.0, true);
  EXPECT_DOUBLE_EQ(ground_force(ground, 0.01, 0.5), 20.0);
  EXPECT_DOUBLE_EQ(ground_force(ground, 0.01, -1.0), -10.0);
  EXPECT_EQ(ground_force(ground, 0.0, 1.0), 0.0);
  EXPECT_EQ(ground_force(ground, -0.01, 1.0), 0.0);
}

TEST(GroundForce, OfTheForceLawNeverPulls) {
  const Ground ground = penalty_ground(1000.0, 20.0, false);
  EXPECT_DOUBLE_EQ(ground_force(ground, 0.01, 0.5), 20.0);
  EXPECT_DOUBLE_EQ(ground_force(ground, 0.01, -0.25), 5.0);
  EXPECT_EQ(ground_force(ground, 0.01, -1.0), 0.0);
}

// ---- one bounce, by Runge-Kutta ----------------------------------------------------------------

struct Bounce {
  double restitution = 0.0;      // leaving / impact speed
  double max_penetration = 0.0;  // m
  double time = 0.0;             // s in contact, until back at the surface
};

struct Depth {
  double depth, rate;  // m, m/s
};

Depth operator+(const Depth& a, const Depth& b) { return {a.depth + b.depth, a.rate + b.rate}; }
Depth operator*(double s, const Depth& a) { return {s * a.depth, s * a.rate}; }

struct Drop {
  Ground ground;
  double mass = 1.0;     // kg
  double gravity = 0.0;  // m/s^2
  double speed = 1.0;    // m/s at the surface

  Depth rates(const Depth& d) const {
    return {d.rate, gravity - ground_force(ground, d.depth, d.rate) / mass};
  }

  Depth stepped(const Depth& d, double dt) const {
    const Depth k1 = rates(d), k2 = rates(d + 0.5 * dt * k1), k3 = rates(d + 0.5 * dt * k2);
    const Depth k4 = rates(d + dt * k3);
    return d + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }

  // Comes back to the surface by ever smaller steps: none evaluates the force beyond it.
  Bounce bounce() const {
    double dt = 1e-5 * std::sqrt(mass / ground.stiffness);
    const double smallest = 1e-12 * dt;
    Depth now{1e-12, speed};
    Bounce result;
    while (dt > smallest) {
      const Depth next = stepped(now, dt);
      if (next.depth <= 0.0) {
        dt *= 0.5;
        continue;
      }
      now = next;
      result.time += dt;
      result.max_penetration = std::max(result.max_penetration, now.depth);
    }
    result.restitution = -now.rate / speed;
    return result;
  }

  // depth = sag + exp(-beta t) (A cos w t + B sin w t), where its rate is zero.
  double closed_form_of_max_penetration() const {
    const double sag = mass * gravity / ground.stiffness, beta = 0.5 * ground.damping / mass;
    const double w = std::sqrt(ground.stiffness / mass - beta * beta);
    const double A = -sag, B = (speed + beta * A) / w;
    const double t = std::atan2(w * B - beta * A, beta * B + w * A) / w;
    return sag + std::exp(-beta * t) * (A * std::cos(w * t) + B * std::sin(w * t));
  }
};

constexpr double kMass = 0.3, kStiffness = 2000.0, kSpeed = 2.5;

double damping_of(double zeta) { return 2.0 * zeta * std::sqrt(kStiffness * kMass); }

Bounce weightless_bounce(double zeta, bool adhesive) {
  const Ground ground = penalty_ground(kStiffness, damping_of(zeta), adhesive);
  return Drop{.ground = ground, .mass = kMass, .speed = kSpeed}.bounce();
}

// m g d + m v^2 / 2 = k d^2 / 2, and all the speed back.
TEST(GroundForce, UndampedTakesAndReturnsTheEnergyOfTheFall) {
  constexpr double g = 9.81;
  const double sag = kMass * g / kStiffness;
  const double deepest = sag + std::sqrt(sag * sag + kMass * kSpeed * kSpeed / kStiffness);
  for (bool adhesive : {false, true}) {
    const Ground ground = penalty_ground(kStiffness, 0.0, adhesive);
    const Bounce b = Drop{ground, kMass, g, kSpeed}.bounce();
    EXPECT_NEAR(b.max_penetration, deepest, 1e-9 * deepest);
    EXPECT_NEAR(b.restitution, 1.0, 1e-9);
  }
}

// Half a period of the damped oscillation.
TEST(GroundForce, OfTheOverlapLawReturnsHalfAPeriodsDecay) {
  for (double zeta : {0.05, 0.3, 0.7}) {
    const double root = std::sqrt(1.0 - zeta * zeta), omega = std::sqrt(kStiffness / kMass);
    const Bounce b = weightless_bounce(zeta, true);
    EXPECT_NEAR(b.restitution, std::exp(-pi * zeta / root), 1e-9);
    EXPECT_NEAR(b.time, pi / (omega * root), 1e-9 * b.time);
  }
}

// Schwager and Poeschel (2007), for beta < omega_0 / sqrt(2) and beyond.
TEST(GroundForce, OfTheForceLawReturnsWhatSchwagerAndPoeschelFound) {
  for (double zeta : {0.05, 0.3, 0.7, 0.9}) {
    const double beta = damping_of(zeta) / (2.0 * kMass);
    const double omega = std::sqrt(kStiffness / kMass - beta * beta);
    const double angle = pi - std::atan2(2.0 * beta * omega, omega * omega - beta * beta);
    const Bounce b = weightless_bounce(zeta, false);
    EXPECT_NEAR(b.restitution, std::exp(-beta / omega * angle), 1e-9) << zeta;
  }
}

// Points dropped from h with gravity on all the time, integrated elsewhere.
struct DropCase {
  double stiffness, mass, height, damping;
  double restitution_overlap, restitution_force, time_overlap;
};

TEST(GroundForce, OnADroppedPointGivesTheReferenceBounce) {
  constexpr double g = 9.81;
  for (const DropCase& c :
       {DropCase{1e4, 0.1, 1.0, 5.0, 0.7774844102468412, 0.7873191715140737, 0.010016404010723607},
        DropCase{2e3, 0.01, 0.2, 1.0, 0.6979966790317728, 0.7158805342299762,
                 0.007129335983543711}}) {
    const double speed = std::sqrt(2.0 * g * c.height);
    const auto drop = [&](bool adhesive) {
      return Drop{penalty_ground(c.stiffness, c.damping, adhesive), c.mass, g, speed};
    };
    const Bounce overlap = drop(true).bounce();
    const double deepest = drop(true).closed_form_of_max_penetration();
    EXPECT_NEAR(overlap.max_penetration, deepest, 1e-9 * deepest);
    EXPECT_NEAR(overlap.restitution, c.restitution_overlap, 1e-9);
    EXPECT_NEAR(overlap.time, c.time_overlap, 1e-9 * c.time_overlap);
    EXPECT_NEAR(drop(false).bounce().restitution, c.restitution_force, 1e-9);
  }
}

}  // namespace
}  // namespace limber
