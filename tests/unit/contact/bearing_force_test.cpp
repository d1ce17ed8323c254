#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/contact/passive_contact.h"
#include "core/contact/penalty.h"

// The law of contacts that bear loads.

namespace limber {
namespace {

constexpr double kGravity = 9.81;   // m/s^2
constexpr double kPointMass = 0.5;  // kg
constexpr double kStep = 1e-3;      // s
constexpr double kGain = kStep / kPointMass;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// Of a chain of points: the step's limit is 4 m / dt^2.
constexpr double kSpringShare = 0.175;

// A column of points, each with the mass for which contacts are made, that carries a weight; it
// falls on a floor at height 0. Of the weight the contact knows only what the springs do.
class Column {
 public:
  PenaltyContact law;
  double gravity = kGravity;

  Column(double weight, double speed) : mass_(kPoints, kPointMass), velocity_(kPoints, -speed) {
    mass_.back() = weight;
    for (int i = 0; i < kPoints; ++i) height_.push_back(i * kApart);
  }

  double depth() const { return -height_[0]; }
  double speed() const { return velocity_[0]; }
  double mass() const {
    double sum = 0.0;
    for (double m : mass_) sum += m;
    return sum;
  }
  double momentum() const {
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i) sum += mass_[i] * velocity_[i];
    return sum;
  }
  double depth_at_rest() const {
    return mass() * gravity / (law.frequency * law.frequency * kPointMass);
  }
  void press_in(double by) {
    for (double& h : height_) h -= by;
    books_.stored = law.elastic_energy(kPointMass, by);
  }

  void step() {
    std::vector<double> force(kPoints);
    for (int i = 0; i < kPoints; ++i) force[i] = -mass_[i] * gravity;
    for (int i = 0; i + 1 < kPoints; ++i) {
      const double pull = kStiffness * (height_[i + 1] - height_[i] - kApart) +
                          kDamping * (velocity_[i + 1] - velocity_[i]);
      force[i] += pull;
      force[i + 1] -= pull;
    }
    force[0] += press(force[0]);
    for (int i = 0; i < kPoints; ++i) {
      velocity_[i] += force[i] / mass_[i] * kStep;
      height_[i] += velocity_[i] * kStep;
    }
  }
  void run(double seconds) {
    for (double t = 0.0; t < seconds; t += kStep) step();
  }

 private:
  double press(double others) {
    if (books_.open) books_.settle(-velocity_[0]);
    if (depth() <= 0.0) {
      books_ = {};
      return 0.0;
    }
    books_.share_mass(kPointMass);
    const double foreseen = -(velocity_[0] + others / kPointMass * kStep);
    const double without = books_.closing_without(foreseen);
    const double force = std::min(bearing_force(law, kPointMass, depth(), -without, kGain, kStep),
                                  books_.largest_impulse(0.5 * (without - velocity_[0])) / kStep);
    books_.give(force * kStep, -velocity_[0], foreseen - force * kGain);
    return force;
  }

  static constexpr int kPoints = 5;
  static constexpr double kApart = 0.1;                                                    // m
  static constexpr double kStiffness = 4.0 * kSpringShare * kPointMass / (kStep * kStep);  // N/m
  static constexpr double kDamping = 0.1 * kPointMass / kStep;                             // N s/m

  std::vector<double> mass_, height_, velocity_;
  PassiveContact books_;
};

constexpr PenaltyContact kLaw{.frequency = 300.0, .restitution = 0.3};

TEST(BearingForce, LiesBetweenTheTwoOfMooreAndWilhelms) {
  for (double depth : {1e-6, 1e-3, 0.5}) {
    const double elastic = kLaw.elastic_force(kPointMass, depth);
    double last = elastic;
    for (double speed = -3.0; speed < 3.0; speed += 1e-3) {
      const double force = bearing_force(kLaw, kPointMass, depth, speed, kGain, kStep);
      EXPECT_LE(force, last);  // the faster it leaves, the less
      last = force;
    }
    EXPECT_DOUBLE_EQ(bearing_force(kLaw, kPointMass, depth, -100.0, kGain, kStep), elastic);
    EXPECT_DOUBLE_EQ(bearing_force(kLaw, kPointMass, depth, 100.0, kGain, kStep), 0.09 * elastic);
  }
  EXPECT_EQ(bearing_force(kLaw, kPointMass, -1e-3, -1.0, kGain, kStep), 0.0);
}

// k d (1 - s / s_out) at the speed s that the force itself leads to.
TEST(BearingForce, IsADamperAtTheSpeedAfterTheSubstep) {
  for (double depth : {1e-3, 0.05}) {
    for (double share : {0.1, 0.5, 0.9}) {
      const double elastic = kLaw.elastic_force(kPointMass, depth);
      const double kick = elastic * kStep / kPointMass;
      const double out = depth < 0.01 ? depth / 0.1 : 0.1;
      const double without = share * out - kick;  // leaves at less than s_out
      const double force = bearing_force(kLaw, kPointMass, depth, without, kGain, kStep);
      const double after = without + force * kStep / kPointMass;
      EXPECT_NEAR(force, elastic * (1.0 - after / out), 1e-12 * elastic) << depth << ", " << share;
      EXPECT_GT(after, 0.0);
      EXPECT_LT(after, out);
    }
  }
}

// A free hit: the contact's point alone.
TEST(BearingForce, GivesBackItsRestitution) {
  for (double e : {0.2, 0.5, 0.9, 1.0}) {
    const PenaltyContact law{.frequency = 300.0, .restitution = e};
    constexpr double kSpeed = 2.0, kFine = 1e-6;
    double height = 0.0, velocity = -kSpeed;
    do {
      velocity += bearing_force(law, 1.0, -height, velocity, kFine, kFine) * kFine;
      height += velocity * kFine;
    } while (height < 0.0);
    // Below s_out it gives more than e^2: as much as half of s_out at the end of the way in.
    EXPECT_NEAR(velocity / kSpeed, e, 0.5 * kYieldSpeed / kSpeed) << "restitution " << e;
  }
}

// What Moore and Wilhelms' law does not: it would rest between the elastic depth and 1 / e^2 = 11
// times that, and tremble by what the load does in a substep, up to 10 m/s.
TEST(BearingForce, BearsALoadAtItsElasticDepthWithoutTrembling) {
  for (double weight : {1.0, 10.0, 100.0, 1000.0}) {
    Column column(weight * kPointMass, 1.0);
    column.law = kLaw;
    column.run(10.0);
    EXPECT_NEAR(column.depth(), column.depth_at_rest(), 1e-3 * column.depth_at_rest()) << weight;
    EXPECT_LT(std::abs(column.speed()), 1e-4) << weight;
  }
}

// Deeper than it may be: it is stopped, not thrown back.
TEST(BearingForce, StopsWhatIsTooDeep) {
  PenaltyContact law = kLaw;
  law.deepest = 0.01;
  for (double closing : {2.0, 3.0, 100.0}) {
    const double force = bearing_force(law, kPointMass, 0.012, -closing, kGain, kStep);
    const double elastic = law.elastic_force(kPointMass, 0.012);
    EXPECT_DOUBLE_EQ(force, closing / kGain);
    EXPECT_GT(force, elastic);
  }
  EXPECT_LE(bearing_force(law, kPointMass, 0.012, 3.0, kGain, kStep),
            law.elastic_force(kPointMass, 0.012));
}

TEST(BearingForce, LetsNothingFarBeyondItsDeepest) {
  for (double weight : {1.0, 30.0, 1000.0}) {
    for (double deepest : {0.01, kUnlimited}) {
      Column column(weight * kPointMass, 5.0);
      column.law = kLaw;
      column.law.deepest = deepest;
      double deepest_seen = 0.0;
      for (int n = 0; n < 2000; ++n) {
        column.step();
        deepest_seen = std::max(deepest_seen, column.depth());
      }
      if (deepest < kUnlimited) {
        EXPECT_LT(deepest_seen, 0.011) << weight;
      } else {
        EXPECT_GT(deepest_seen, 0.015) << weight << ": the springs alone";
      }
    }
  }
}

// What an implicit solver has behind the point: heavier than the contact knows, under a load that
// it is not told of. It goes by what was missing in the last substep.
TEST(BearingForce, BearsALoadItIsNotToldOf) {
  for (double mass : {kPointMass, 3.0 * kPointMass, 30.0 * kPointMass}) {
    double height = 0.01, velocity = 0.0;
    PassiveContact books;
    books.share_mass(kPointMass);
    books.stored = 1e3;  // J: not the books' test
    for (int n = 0; n < 10000; ++n) {
      if (books.open) books.settle(-velocity);
      const double without = -books.closing_without(-velocity);
      const double force = bearing_force(kLaw, kPointMass, -height, without, kGain, kStep);
      books.give(force * kStep, -velocity, -velocity - force * kGain);
      velocity += (force / mass - kGravity) * kStep;
      height += velocity * kStep;
    }
    const double at_rest = -mass * kGravity / (9e4 * kPointMass);
    EXPECT_NEAR(height, at_rest, 1e-6 * std::abs(at_rest)) << mass;
    EXPECT_LT(std::abs(velocity), 1e-8) << mass;
  }
}

// The weight on its springs, drawn out at s_out, swings up to twice that.
TEST(BearingForce, LetsOutSlowlyWhatWasPressedIn) {
  Column column(30.0 * kPointMass, 0.0);
  column.law = {.frequency = 300.0};
  column.press_in(10.0 * column.depth_at_rest());
  double fastest = 0.0;
  for (int n = 0; n < 5000; ++n) {
    column.step();
    fastest = std::max(fastest, column.momentum() / column.mass());
  }
  EXPECT_LT(fastest, 2.2 * kYieldSpeed);
  EXPECT_GT(fastest, 0.5 * kYieldSpeed);
  EXPECT_NEAR(column.depth(), column.depth_at_rest(), 1e-3 * column.depth_at_rest());
}

}  // namespace
}  // namespace limber
