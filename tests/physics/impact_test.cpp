// Contact and fracture.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/operators/time_operator.h"
#include "core/storage/state_hash.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

// A spring with a dashpot under every point below y = 0. It keeps its own books.
class PenaltyFloor : public SubstepCoupling {
 public:
  PenaltyFloor(double stiffness, double damping) : stiffness_(stiffness), damping_(damping) {}

  void add_forces(Lattice& lattice, double dt) override {
    for (std::int32_t p : lattice.dynamic_points) {
      const auto& [x, v] = lattice.motion[p];
      if (x.y() >= 0.0) continue;
      const double push = std::max(0.0, -stiffness_ * x.y() - damping_ * v.y());
      lattice.force[p].y() += push;
      impulse += push * dt;
      pressed_.push_back({p, push});
    }
  }

  // Work with the new velocity: the one the points moved with.
  void advance(Lattice& lattice, double dt) override {
    for (const auto& [p, push] : pressed_) work += push * lattice.motion[p].velocity.y() * dt;
    pressed_.clear();
  }

  double impulse = 0.0;  // N s
  double work = 0.0;     // J, on the lattice

 private:
  double stiffness_, damping_;
  std::vector<std::pair<std::int32_t, double>> pressed_;
};

PhysicalModel unbreakable_block(const Vec3& origin, double damping) {
  PhysicalModel model = test::block({.cells = {2, 2, 2}, .origin = origin});
  for (EdgeAttributes& e : model.edges) {
    e.stiffness = 1e4;
    e.damping = damping;
    e.break_threshold = kUnbreakable;
  }
  return model;
}

struct Bounce {
  double before, after;  // J
  double work;           // J, of the floor
  double impulse_defect_rel;
};

Bounce bounce(double floor_damping) {
  PhysicalModel model = unbreakable_block({0.0, 0.001, 0.0}, 0.0);
  set_in_motion(model, {0.0, -2.0, 0.0}, Vec3::Zero());
  Lattice lattice = test::lattice_of({model});
  TimeOperator time(lattice);
  PenaltyFloor floor(5e3, floor_damping);
  const test::Totals before = test::totals(lattice);
  const double dt = 0.02 * time.largest_step();
  time.advance(static_cast<int>(0.8 / dt), dt, kEmptySpace, &floor);
  const test::Totals after = test::totals(lattice);
  EXPECT_GT(lattice.motion[0].position.y(), 0.0);
  const double gained = after.momentum.y() - before.momentum.y();
  return {before.energy(), after.energy(), floor.work, gained / floor.impulse - 1.0};
}

TEST(Floor, WithoutDampingGivesTheEnergyBack) {
  const Bounce b = bounce(0.0);
  EXPECT_NEAR(b.after, b.before, 0.01 * b.before);  // omega dt / 2 = 0.02 at the highest mode
  EXPECT_NEAR(b.impulse_defect_rel, 0.0, 1e-12);
}

TEST(Floor, TakesTheEnergyThatItsDampersDissipate) {
  const Bounce b = bounce(20.0);
  EXPECT_LT(b.work, -0.1 * b.before);
  EXPECT_NEAR(b.after, b.before + b.work, 0.01 * b.before);
}

// ---------------------------------------------------------------------------------------------

struct Meeting {
  double friction = 0.0;
  double restitution = 1.0;
  Vec3 offset = Vec3(0.0, 0.0, 0.0);  // of the second block, across the way
  Vec3 spin = Vec3::Zero();
};

// Two equal blocks of 27 kg, 1 m apart, closing at 4 m/s: 0.04 of their wave speed
// a sqrt(k / m).
Lattice meeting(const Meeting& how) {
  PhysicalModel left = unbreakable_block({-3.0, 0.0, 0.0}, 0.0);
  PhysicalModel right = unbreakable_block(Vec3(0.0, 0.0, 0.0) + how.offset, 0.0);
  set_in_motion(left, {2.0, 0.0, 0.0}, how.spin);
  set_in_motion(right, {-2.0, 0.0, 0.0}, how.spin);
  for (PhysicalModel* model : {&left, &right}) {
    model->object.friction = how.friction;
    model->object.restitution = how.restitution;
  }
  return test::lattice_of({left, right});
}

double mean_speed(const Lattice& lattice, std::size_t object) {
  const IdRange<PointId> points = lattice.objects[object].points;
  double sum = 0.0;
  for (std::int32_t p = points.begin; p < points.end; ++p) sum += lattice.motion[p].velocity.x();
  return sum / static_cast<double>(points.size());
}

// In quarters of the collision, so that a gain in the middle shows. The contact's own energy is in
// neither sum; semi-implicit Euler adds omega dt / 2 = 2 %.
void expect_momenta_kept_and_no_energy_gained(const Meeting& how) {
  Lattice lattice = meeting(how);
  const test::Totals before = test::totals(lattice);
  TimeOperator time(lattice);
  const double dt = 0.02 * time.largest_step();
  for (int quarter = 0; quarter < 4; ++quarter) {
    time.advance(static_cast<int>(0.3 / dt), dt, kEmptySpace);
    const test::Totals now = test::totals(lattice);
    test::expect_same_momenta(before, now, 1e-12);
    EXPECT_LE(now.energy(), 1.01 * before.energy());
  }
  EXPECT_LT(mean_speed(lattice, 0), 0.5) << "they did not meet";
}

TEST(Collision, HeadOnKeepsMomentaAndGainsNoEnergy) {
  expect_momenta_kept_and_no_energy_gained({});
}

TEST(Collision, OffCentreAndSpinningKeepsMomentaAndGainsNoEnergy) {
  expect_momenta_kept_and_no_energy_gained({.offset = {0.0, 0.7, 0.4}, .spin = {0.5, 0.3, -0.4}});
}

TEST(Collision, WithFrictionKeepsMomentaAndGainsNoEnergy) {
  expect_momenta_kept_and_no_energy_gained(
      {.friction = 0.5, .restitution = 0.5, .offset = {0.0, 0.7, 0.4}, .spin = {0.5, 0.3, -0.4}});
}

// Equal bodies without loss swap velocities but for what stays as vibration.
TEST(Collision, OfEqualBlocksWithoutLossReturnsMostOfTheEnergy) {
  Lattice lattice = meeting({});
  const double before = test::totals(lattice).energy();
  TimeOperator time(lattice);
  const double dt = 0.02 * time.largest_step();
  time.advance(static_cast<int>(1.5 / dt), dt, kEmptySpace);
  EXPECT_NEAR(test::totals(lattice).energy(), before, 0.01 * before);
  EXPECT_LT(mean_speed(lattice, 0), -1.0);
  EXPECT_NEAR(mean_speed(lattice, 0), -mean_speed(lattice, 1), 1e-10);
}

// The outcome must not depend on how many substeps one call makes, although lists of pairs are
// looked at in every fourth substep of a call.
TEST(Collision, OfFastBlocksIsTheSameHoweverTheCallsAreDivided) {
  Lattice together = meeting({}), apart = meeting({});
  TimeOperator one_call(together), many_calls(apart);
  const double dt = 0.5 * one_call.largest_step();
  const int steps = static_cast<int>(0.6 / dt);
  for (Lattice* lattice : {&together, &apart}) {
    for (PointMotion& p : lattice->motion) p.velocity *= 4.0;  // closing at 0.16 of the wave speed
  }
  one_call.advance(steps, dt, kEmptySpace);
  for (int n = 0; n < steps; ++n) many_calls.advance(1, dt, kEmptySpace);
  EXPECT_NEAR(mean_speed(together, 0), mean_speed(apart, 0), 1e-6);
}

// ---------------------------------------------------------------------------------------------

// Holds point 0 at x = 0 as long as the rest drives it beyond: away from the chain (a wall the
// chain runs into) or towards it (a hook the chain is jerked on). It sticks and leaves freely.
class Stop : public SubstepCoupling {
 public:
  explicit Stop(double beyond) : beyond_(beyond) {}
  void add_forces(Lattice& lattice, double dt) override {
    const PointMotion& point = lattice.motion[0];
    const double next_velocity = point.velocity.x() + lattice.force[0].x() * dt / lattice.mass[0];
    if (beyond_ * point.position.x() < 0.0 || beyond_ * next_velocity < 0.0) return;
    lattice.force[0].x() = -point.velocity.x() * lattice.mass[0] / dt;
  }
  void advance(Lattice&, double) override {}

 private:
  double beyond_;  // sign of the x that is closed to the point
};

constexpr double kThreshold = 0.1;  // m
constexpr double kOmega0 = 10.0;    // sqrt(k / m), rad/s

// Ten points of 1 kg, 100 N/m, 1 m apart. Does an edge break within 4 s?
bool chain_breaks(double speed, double beyond) {
  PhysicalModel model = test::chain({.points = 10});
  for (EdgeAttributes& e : model.edges) e.break_threshold = kThreshold;
  set_in_motion(model, {beyond * speed, 0.0, 0.0}, Vec3::Zero());
  Lattice lattice = test::lattice_of({model});
  Stop stop(beyond);
  return !TimeOperator(lattice).advance(20000, 2e-4, kEmptySpace, &stop).breaks.empty();
}

// Exact modal propagation of the ten points: the front overshoots to 1.21856 v / omega0.
TEST(Fracture, OfAChainJerkedOnAHookIsThatOfItsFront) {
  const double critical = kThreshold * kOmega0 / 1.218556;
  EXPECT_FALSE(chain_breaks(0.99 * critical, 1.0));
  EXPECT_TRUE(chain_breaks(1.01 * critical, 1.0));
}

// Against a wall the same front compresses, which breaks nothing; the largest stretch, after the
// rebound, is 0.703309 v / omega0.
TEST(Fracture, OfAChainThatHitsAWallIsThatOfItsRebound) {
  const double critical = kThreshold * kOmega0 / 0.703309;
  EXPECT_FALSE(chain_breaks(0.98 * critical, -1.0));
  EXPECT_TRUE(chain_breaks(1.02 * critical, -1.0));
}

Lattice pulled_dumbbell(double relative_speed) {
  PhysicalModel model = test::chain({.points = 2});
  model.edges[EdgeId(0)].break_threshold = kThreshold;
  model.points[PointId(0)].velocity.x() = -0.5 * relative_speed;
  model.points[PointId(1)].velocity.x() = 0.5 * relative_speed;
  return test::lattice_of({model});
}

// omega = sqrt(2 k / m); s = v / omega sin(omega t) reaches b at asin(b omega / v) / omega if
// v > b omega, and the halves leave with sqrt(v^2 - (b omega)^2).
TEST(Fracture, OfADumbbellHappensAtTheCriticalSpeedAndTime) {
  const double omega = std::sqrt(200.0), critical = kThreshold * omega;
  Lattice slow = pulled_dumbbell(0.999 * critical);
  EXPECT_TRUE(TimeOperator(slow).advance(50000, 1e-5, kEmptySpace).breaks.empty());

  Lattice fast = pulled_dumbbell(1.5);
  const StepReport report = TimeOperator(fast).advance(50000, 1e-5, kEmptySpace);
  ASSERT_EQ(report.breaks.size(), 1u);
  EXPECT_NEAR(report.breaks[0].time, std::asin(critical / 1.5) / omega, 5e-5);
  EXPECT_NEAR(report.breaks[0].where.x(), 0.5, 1e-12);
  const double apart = fast.motion[1].velocity.x() - fast.motion[0].velocity.x();
  EXPECT_NEAR(apart, 0.5, 2e-3);  // sqrt(1.5^2 - 0.01 * 200)
}

// Uneven masses, spinning, torn apart by a vibration.
Lattice bursting_block() {
  PhysicalModel model = test::block({.cells = {3, 2, 2}, .origin = {1.0, 2.0, 3.0}});
  int i = 0;
  for (PointAttributes& p : model.points) p.mass = 0.5 + (i++ * 7 % 11) / 5.0;
  model.object.internal_damping = 1.0;
  model.object.friction = 0.0;
  set_in_motion(model, {0.3, -0.2, 0.1}, {0.4, 0.2, -0.5});
  Lattice lattice = test::lattice_of({model});
  test::shake(lattice, 71, 2.0);
  return lattice;
}

TEST(Fracture, KeepsMomentumAndAngularMomentum) {
  Lattice lattice = bursting_block();
  const test::Totals before = test::totals(lattice);
  TimeOperator time(lattice);
  const StepReport report = time.advance(3000, 0.1 * time.largest_step(), kEmptySpace);
  EXPECT_GT(report.breaks.size(), 3u);
  EXPECT_GT(report.broken_edges, report.breaks.size());
  EXPECT_GT(time.pieces().count, 1);
  test::expect_same_momenta(before, test::totals(lattice), 1e-12);
  EXPECT_LT(test::totals(lattice).energy(), before.energy());
}

TEST(Fracture, ReportsBreaksInOrderAndAsTheyAreInTheState) {
  Lattice lattice = bursting_block();
  TimeOperator time(lattice);
  const StepReport report = time.advance(3000, 0.1 * time.largest_step(), kEmptySpace);
  EXPECT_TRUE(std::is_sorted(report.breaks.begin(), report.breaks.end(),
                             [](const auto& l, const auto& r) { return l.time < r.time; }));
  for (const BreakEvent& b : report.breaks) EXPECT_EQ(lattice.breaking.edge_broken[b.edge], 1);
  EXPECT_EQ(static_cast<std::size_t>(std::count(lattice.breaking.edge_broken.begin(),
                                                lattice.breaking.edge_broken.end(), 1)),
            report.broken_edges);
}

std::uint64_t hash_of(const Lattice& lattice) {
  StateHash hash;
  hash.add(std::span<const PointMotion>(lattice.motion));
  hash.add(std::span<const std::uint8_t>(lattice.breaking.edge_broken));
  return hash.value();
}

TEST(Determinism, TwoRunsWithFractureAndContactHaveTheSameBits) {
  const auto run = [] {
    Lattice lattice = bursting_block();
    TimeOperator time(lattice);
    PenaltyFloor floor(100.0, 1.0);
    const double dt = 0.3 * time.largest_step();
    time.advance(5000, dt, {.gravity = {0.0, -9.81, 0.0}}, &floor);
    return hash_of(lattice);
  };
  EXPECT_EQ(run(), run());
  EXPECT_NE(run(), hash_of(bursting_block()));
}

}  // namespace
}  // namespace limber
