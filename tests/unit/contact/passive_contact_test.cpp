#include "core/contact/passive_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/contact/penalty.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

// A mass that one contact presses, as bodies and faces of lattices press points.
struct Pressed {
  double mass = 1.0;  // kg
  Vec3 velocity = Vec3::Zero();
  PassiveContact books;
  double taken = 0.0, given = 0.0;  // J, by the mass's own kinetic energy

  double kinetic() const { return 0.5 * mass * velocity.squaredNorm(); }

  void press(const PenaltyContact& law, const Vec3& normal, double depth, double dt) {
    books.share_mass(mass);
    const double separation = velocity.dot(normal);
    const double without = books.closing_without(-separation);
    const double wanted = bearing_force(law, books.mass, depth, -without, dt / mass, dt) * dt;
    const double impulse = std::min(wanted, books.largest_impulse(-separation));
    const double before = kinetic();
    velocity += impulse / mass * normal;
    (kinetic() < before ? taken : given) += std::abs(kinetic() - before);
    books.give(impulse, -separation, -separation - impulse / mass);
    books.settle(-velocity.dot(normal));
  }
};

// The impulse that makes up for the approach and what is stored, by energy: it leaves with
// sqrt(u^2 + 2 E / m).
TEST(PassiveContact, LargestImpulseGivesAllThatIsStored) {
  for (double closing : {-2.0, -0.5, 0.0, 3.0}) {
    for (double stored : {0.0, 0.1, 40.0}) {
      constexpr double kMass = 2.5;
      const double leaves = largest_passive_impulse(kMass, closing, stored) / kMass - closing;
      const double energy = 0.5 * kMass * closing * closing + stored;
      EXPECT_NEAR(0.5 * kMass * leaves * leaves, energy, 1e-13 * (1.0 + energy))
          << closing << ", " << stored;
    }
  }
  EXPECT_EQ(largest_passive_impulse(2.5, -3.0, 0.0), 0.0);         // leaves, and nothing to give
  EXPECT_EQ(largest_passive_impulse(2.5, -3.0, -1.0), 0.0);        // still less
  EXPECT_DOUBLE_EQ(largest_passive_impulse(2.5, 3.0, -1e9), 7.5);  // in debt: stops it at the most
}

// A load that pushes it in between: what is done in all is J times the mean of the speeds.
TEST(PassiveContact, LargestImpulseHoldsALoad) {
  constexpr double kMass = 2.5, kStored = 0.1;  // kg, J
  for (double before : {-0.1, 0.0, 0.2}) {
    for (double load : {0.5, 10.0}) {  // N s
      const double without = before + load / kMass;
      const double most = largest_passive_impulse(kMass, 0.5 * (before + without), kStored);
      const double after = without - most / kMass;
      EXPECT_NEAR(most * 0.5 * (before + after), -kStored, 1e-13 * (kStored + most * load / kMass));
    }
  }
}

// Depth, normal, stiffness and the mass change from substep to substep as nothing real does, and
// the mass is pushed about between: whatever a contact gives it has taken before.
TEST(PassiveContact, NeverGivesMoreThanItTook) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int run = 0; run < 20; ++run) {
    Pressed body;
    for (int n = 0; n < 2000; ++n) {
      body.velocity += test::random_vector(random, 0.1);
      const PenaltyContact law{.frequency = 1e3 * share(random),
                               .restitution = share(random),
                               .soft_depth = 1e-3,
                               .deep_frequency = 1e4 * share(random)};
      const Vec3 normal = test::random_vector(random, 1.0).normalized();
      body.mass = 0.5 + share(random);
      body.press(law, normal, 0.1 * (share(random) - 0.3), 1e-3);
      const double rounding = 1e-13 * (body.taken + body.kinetic());  // J
      ASSERT_GE(body.taken - body.given, -rounding) << "run " << run << ", substep " << n;
      ASSERT_NEAR(body.books.stored, body.taken - body.given, rounding);
    }
    EXPECT_GT(body.given, 0.1 * body.taken);  // it pushes back
  }
}

// What the books are for: the law alone pumps energy where its normal swings.
TEST(PassiveContact, WithoutBooksTheSameWouldGainEnergy) {
  std::mt19937 random(12);
  const PenaltyContact law{.frequency = 1e3, .restitution = 1.0};
  Pressed with;
  Vec3 without = Vec3::Zero();
  for (int n = 0; n < 1000; ++n) {
    const Vec3 normal = test::random_vector(random, 1.0).normalized();
    with.press(law, normal, 1e-3, 1e-3);
    without += penalty_force(law, 1.0, 1e-3, without.dot(normal)) * 1e-3 * normal;
  }
  EXPECT_EQ(with.kinetic(), 0.0);
  EXPECT_GT(without.norm(), 1.0);
}

// Into the surface at 2 m/s and out again; speed of rebound per speed of approach.
double rebound(const PenaltyContact& law, double dt) {
  Pressed ball;
  const double speed = 2.0;
  ball.velocity = -speed * Vec3::UnitY();
  double height = 0.0;
  do {
    ball.press(law, Vec3::UnitY(), -height, dt);
    height += ball.velocity.y() * dt;
  } while (height < 0.0);
  return ball.velocity.y() / speed;
}

// A soft skin of a millimetre; 2 m/s go through it. A substep at most is pushed too long or too
// short: omega dt = 1 % of the speed.
TEST(PassiveContact, ReboundsWithRestitutionOneAndZero) {
  PenaltyContact law{.frequency = 300.0, .soft_depth = 1e-3, .deep_frequency = 1000.0};
  constexpr double kStep = 1e-5;
  law.restitution = 1.0;
  EXPECT_NEAR(rebound(law, kStep), 1.0, 0.01);
  law.restitution = 0.0;
  EXPECT_LE(rebound(law, kStep), kYieldSpeed / 2.0);
}

// At steps so long that a substep decides, too.
TEST(PassiveContact, NeverReboundsFasterThanItCame) {
  for (double frequency : {10.0, 300.0, 2000.0}) {
    for (double dt : {1e-5, 1e-4, 7e-4, 1e-3}) {
      const PenaltyContact law{.frequency = frequency, .restitution = 1.0};
      EXPECT_LE(rebound(law, dt), 1.0 + 1e-12) << frequency << " rad/s, " << dt << " s";
    }
  }
}

// A partner that becomes lighter counts from then on; one that becomes heavier does not give.
TEST(PassiveContact, MassNeverGrows) {
  PassiveContact books;
  for (double mass : {3.0, 2.0, 5.0}) books.share_mass(mass);
  EXPECT_EQ(books.mass, 2.0);
  EXPECT_DOUBLE_EQ(books.largest_impulse(1.5), 6.0);
}

// -1 m/s was foreseen; it closed faster by 0.25 m/s, and is taken to do so again.
TEST(PassiveContact, KnowsWhatItHasNotForeseen) {
  PassiveContact books;
  books.share_mass(0.5);
  books.give(2.0, 3.0, -1.0);
  EXPECT_TRUE(books.open);
  books.settle(-0.75);
  EXPECT_FALSE(books.open);
  EXPECT_DOUBLE_EQ(books.closing_without(7.0), 7.25);
}

TEST(PassiveContact, ForgivingNeverTakesAwayWhatIsStored) {
  PassiveContact books;
  books.forgive(2.0);
  EXPECT_EQ(books.stored, 2.0);
  books.forgive(1.0);
  EXPECT_EQ(books.stored, 2.0);
}

}  // namespace
}  // namespace limber
