#include "core/dynamics/internal_damping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kGamma = 3.0;  // 1/s
constexpr double kTime = 0.2;   // s

PhysicalModel damped_block(const Vec3& origin, double gamma) {
  PhysicalModel model = test::block({.cells = {2, 2, 3}, .origin = origin});
  int i = 0;
  for (PointAttributes& p : model.points) p.mass = 0.5 + (i++ * 7 % 11) / 5.0;
  model.object.internal_damping = gamma;
  return model;
}

// Far from the origin, spinning and flying, with a vibration on top.
Lattice shaken_block() {
  PhysicalModel model = damped_block({4.0, -3.0, 2.0}, kGamma);
  set_in_motion(model, {5.0, 1.0, -2.0}, {1.0, 2.0, -3.0});
  Lattice lattice = test::lattice_of({model});
  test::shake(lattice, 11, 2.0);
  return lattice;
}

std::vector<Vec3> vibration(const Lattice& lattice) {
  const RigidMotion body = rigid_motion(lattice.motion, lattice.mass, lattice.dynamic_points);
  std::vector<Vec3> velocities;
  for (const PointMotion& p : lattice.motion) {
    velocities.push_back(p.velocity - body.velocity_at(p.position));
  }
  return velocities;
}

TEST(InternalDamping, KeepsMomentumAndAngularMomentum) {
  Lattice lattice = shaken_block();
  const test::Totals before = test::totals(lattice);
  damp_internally(lattice, components(lattice), kTime);
  test::expect_same_momenta(before, test::totals(lattice), 1e-14);
}

TEST(InternalDamping, MakesTheVibrationDecayWithExpOfGammaT) {
  Lattice lattice = shaken_block();
  const std::vector<Vec3> before = vibration(lattice);
  damp_internally(lattice, components(lattice), kTime);
  const std::vector<Vec3> after = vibration(lattice);
  for (std::size_t p = 0; p < before.size(); ++p) {
    EXPECT_LE((after[p] - std::exp(-kGamma * kTime) * before[p]).norm(), 1e-13);
  }
}

TEST(InternalDamping, ReturnsTheKineticEnergyThatIsGone) {
  Lattice lattice = shaken_block();
  const double before = test::totals(lattice).kinetic;
  const double loss = damp_internally(lattice, components(lattice), kTime);
  EXPECT_GT(loss, 1.0);
  EXPECT_NEAR(loss, before - test::totals(lattice).kinetic, 1e-12 * before);
}

TEST(InternalDamping, DoesNotDependOnHowTheTimeIsDivided) {
  Lattice once = shaken_block(), often = shaken_block();
  damp_internally(once, components(once), kTime);
  for (int i = 0; i < 10; ++i) damp_internally(often, components(often), kTime / 10);
  for (std::size_t p = 0; p < once.motion.size(); ++p) {
    EXPECT_LE((once.motion[p].velocity - often.motion[p].velocity).norm(), 1e-13);
  }
}

TEST(InternalDamping, LeavesARigidMotionAlone) {
  PhysicalModel model = damped_block({4.0, -3.0, 2.0}, kGamma);
  set_in_motion(model, {5.0, 1.0, -2.0}, {1.0, 2.0, -3.0});
  Lattice lattice = test::lattice_of({model});
  const std::vector<PointMotion> before = lattice.motion;
  const double loss = damp_internally(lattice, components(lattice), 10.0);
  EXPECT_NEAR(loss, 0.0, 1e-25);
  for (std::size_t p = 0; p < before.size(); ++p) {
    EXPECT_LE((lattice.motion[p].velocity - before[p].velocity).norm(), 1e-13);
  }
}

// Two pieces of one object that fly apart: drawn to the motion of the whole, they would stop.
TEST(InternalDamping, ActsOnEveryPieceByItself) {
  PhysicalModel model = test::chain({.points = 4});
  model.object.internal_damping = kGamma;
  for (std::size_t p : {0u, 1u}) model.points[PointId(p)].velocity = {-1.0, 0.0, 0.0};
  for (std::size_t p : {2u, 3u}) model.points[PointId(p)].velocity = {2.0, 0.5, 0.0};
  Lattice lattice = test::lattice_of({model});
  const std::vector<std::int32_t> middle = {1};
  break_edges(lattice.topology, lattice.breaking, middle);
  EXPECT_NEAR(damp_internally(lattice, components(lattice), kTime), 0.0, 1e-25);
  EXPECT_NEAR(lattice.motion[0].velocity.x(), -1.0, 1e-14);
  EXPECT_NEAR(lattice.motion[3].velocity.x(), 2.0, 1e-14);
}

TEST(InternalDamping, IsThatOfEachObject) {
  Lattice lattice =
      test::lattice_of({damped_block({0.0, 0.0, 0.0}, 0.0), damped_block({9.0, 0.0, 0.0}, kGamma)});
  test::shake(lattice, 12, 1.0);
  const std::vector<PointMotion> before = lattice.motion;
  damp_internally(lattice, components(lattice), kTime);
  const IdRange<PointId> undamped = lattice.objects[0].points;
  for (std::int32_t p = undamped.begin; p < undamped.end; ++p) {
    EXPECT_EQ(lattice.motion[p].velocity, before[p].velocity);
  }
  EXPECT_NE(lattice.motion.back().velocity, before.back().velocity);
}

// ---- where positions are ahead of velocities

TEST(InternalDamping, KeepsMomentaAlsoWherePositionsLead) {
  Lattice lattice = shaken_block();
  const test::Totals before = test::totals(lattice);
  damp_internally(lattice, components(lattice), kTime, std::vector<double>{0.05});
  test::expect_same_momenta(before, test::totals(lattice), 1e-14);
}

// By definition: back to where velocities belong, damped there, forward again.
TEST(InternalDamping, WherePositionsLeadIsThatOfWhereTheyWere) {
  constexpr double kLead = 0.05;
  Lattice lattice = shaken_block(), wanted = lattice;
  damp_internally(lattice, components(lattice), kTime, std::vector<double>{kLead});
  for (PointMotion& m : wanted.motion) m.position -= kLead * m.velocity;
  damp_internally(wanted, components(wanted), kTime);
  for (PointMotion& m : wanted.motion) m.position += kLead * m.velocity;
  for (std::size_t p = 0; p < wanted.motion.size(); ++p) {
    EXPECT_LT((lattice.motion[p].position - wanted.motion[p].position).norm(), 1e-14);
    EXPECT_LT((lattice.motion[p].velocity - wanted.motion[p].velocity).norm(), 1e-14);
  }
}

// An undamped chain at its largest step, its vibration taken out every 32 steps. What energy swings
// by over a period, at most 1 / (1 - 0.92), is all that there may be more than at the start.
Lattice shaken_chain() {
  PhysicalModel model = test::chain({.points = 12, .stiffness = 1e4});
  model.object.internal_damping = 1e6;
  Lattice lattice = test::lattice_of({model});
  test::shake(lattice, 5, 1e-3);
  return lattice;
}

double energy_of_a_chain(bool leads) {
  Lattice lattice = shaken_chain();
  const double before = test::totals(lattice).energy();
  TimeOperator time(lattice);
  const double dt = time.largest_step();
  const std::vector<double> lead = {leads ? 0.5 * dt : 0.0};
  for (int n = 0; n < 100; ++n) {
    lattice.objects[0].authored.object.internal_damping = 0.0;
    time.advance(kDampingInterval, dt, kEmptySpace);
    lattice.objects[0].authored.object.internal_damping = 1e6;
    damp_internally(lattice, components(lattice), kDampingInterval * dt, lead);
  }
  return test::totals(lattice).energy() / before;
}

TEST(InternalDamping, FeedsSymplecticEulerUnlessItKnowsTheLead) {
  EXPECT_GT(energy_of_a_chain(false), 1e3);
  EXPECT_LT(energy_of_a_chain(true), 1.0);
}

TEST(InternalDamping, OfTheTimeOperatorKnowsTheLead) {
  Lattice lattice = shaken_chain();
  const double before = test::totals(lattice).energy();
  TimeOperator time(lattice);
  time.advance(100 * kDampingInterval, time.largest_step(), kEmptySpace);
  EXPECT_LT(test::totals(lattice).energy(), before);
}

}  // namespace
}  // namespace limber
