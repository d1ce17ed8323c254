// Objects that are made implicit one by one, beside explicit ones: in contact with them, breaking,
// and added while others move.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/operators/gluing_operator.h"
#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

class ImplicitObjects : public testing::TestWithParam<SpringPrecision> {
 protected:
  bool single() const { return GetParam() == SpringPrecision::kSingle; }
  TimeOperator time(Lattice& lattice) const {
    return TimeOperator(lattice, Integrator::kSymplecticEuler, GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(Precisions, ImplicitObjects,
                         testing::Values(SpringPrecision::kDouble, SpringPrecision::kSingle),
                         [](const auto& tested) {
                           return tested.param == SpringPrecision::kDouble ? "Double" : "Single";
                         });

PhysicalModel block(double stiffness, double damping_ratio, const Vec3& origin,
                    const std::string& name) {
  PhysicalModel model =
      test::block({.cells = {3, 3, 3}, .spacing = 0.1, .origin = origin, .name = name});
  for (EdgeAttributes& e : model.edges) {
    e.stiffness = stiffness;
    e.damping = 2.0 * damping_ratio * std::sqrt(stiffness);
    e.break_threshold = kUnbreakable;
  }
  return model;
}

// ---- contact of both kinds

struct Collision {
  test::Totals before, after;
  double most_energy = 0.0, impulse = 0.0, dt = 0.0;
};

// A block of `stiffness` flies into a soft one, off centre by one spacing.
Collision collide(double stiffness, bool implicit, SpringPrecision precision) {
  PhysicalModel hard = block(stiffness, 0.1, {0.0, 0.0, 0.0}, "hard");
  PhysicalModel soft = block(1e4, 0.1, {0.45, 0.1, 0.0}, "soft");
  set_in_motion(hard, {2.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  Lattice lattice = test::lattice_of({hard, soft});
  TimeOperator time(lattice, Integrator::kSymplecticEuler, precision);
  if (implicit) time.make_implicit(0);
  Collision result;
  result.dt = 0.5 * time.largest_step();
  result.before = test::totals(lattice);
  for (int n = 0; n * result.dt < 0.5; ++n) {
    time.advance(1, result.dt, kEmptySpace);
    result.most_energy = std::max(result.most_energy, test::totals(lattice).energy());
  }
  result.after = test::totals(lattice);
  for (std::int32_t p = lattice.objects[1].points.begin; p < lattice.objects[1].points.end; ++p) {
    result.impulse += lattice.mass[p] * lattice.motion[p].velocity.x();
  }
  return result;
}

// As it does when all is explicit at a tenth of the step and less: half of the energy goes in
// dampers. Measured: impulses differ by 4.6e-2, energies by 5.5e-3 (the penalty of points against
// faces goes by the step, which is 10 times as long; without faces 2e-3 and 3e-4), P by 1e-14 and,
// of the soft block in single precision, 1e-9.
TEST_P(ImplicitObjects, CollideWithExplicitOnes) {
  const Collision wanted = collide(1e6, false, SpringPrecision::kDouble);
  for (double stiffness : {1e6, 1e8}) {
    SCOPED_TRACE(stiffness);
    const Collision found = collide(stiffness, true, GetParam());
    EXPECT_GT(found.dt, (stiffness == 1e6 ? 9.0 : 1.0) * wanted.dt);
    EXPECT_GT(found.impulse, 40.0);
    EXPECT_NEAR(found.impulse, wanted.impulse, 0.06 * wanted.impulse);
    EXPECT_NEAR(found.after.energy(), wanted.after.energy(), 7e-3 * wanted.after.energy());
    EXPECT_LE(found.most_energy, found.before.energy() * (1.0 + 1e-9));
    const double share = single() ? 1e-8 : 1e-12;
    EXPECT_LE((found.after.momentum - found.before.momentum).norm(),
              share * found.before.momentum_scale);
    EXPECT_LE((found.after.angular_momentum - found.before.angular_momentum).norm(),
              1e-6 * found.before.angular_momentum_scale);
  }
}

// ---- breaking

// A stiff bar that spins apart: the springs across its middle hold less than the others.
PhysicalModel spinning_bar(double stiffness) {
  PhysicalModel model = test::block({.cells = {5, 1, 1}, .spacing = 0.1, .name = "bar"});
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    const double ax = model.geometry.points[a].x(), bx = model.geometry.points[b].x();
    const bool middle = std::min(ax, bx) < 0.25 && std::max(ax, bx) > 0.25;
    model.edges[e].stiffness = stiffness;
    model.edges[e].damping = 0.2 * std::sqrt(stiffness);
    model.edges[e].break_threshold = middle ? 1e-3 * 100.0 / stiffness : kUnbreakable;
  }
  set_in_motion(model, {1.0, 0.0, 0.5}, {0.0, 3.0, 4.0});
  return model;
}

struct PieceMomenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

// Of the half on one side, about the origin.
PieceMomenta momenta_of(const Lattice& lattice, bool right) {
  PieceMomenta sum;
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    if ((lattice.authored_position[p].x() > 0.25) != right) continue;
    sum.linear += lattice.mass[p] * lattice.motion[p].velocity;
    sum.angular += lattice.mass[p] * lattice.motion[p].position.cross(lattice.motion[p].velocity);
  }
  return sum;
}

void expect_near(const PieceMomenta& found, const PieceMomenta& wanted, double spin_share) {
  EXPECT_LE((found.linear - wanted.linear).norm(), 1e-12 * wanted.linear.norm());
  EXPECT_LE((found.angular - wanted.angular).norm(), spin_share * wanted.angular.norm());
}

// In single precision, too: what is implicit is summed in double. The step of 0.02 rad loses a
// share of (omega dt)^2 / 8 = 5e-5 of L at first, once (docs/integrators.md); after that a stiff
// piece keeps its own, and a soft one trades some with its vibration.
TEST_P(ImplicitObjects, BreakAndFlyOnAsPieces) {
  constexpr double kDt = 1.0 / 240, kFirstLoss = 5.5e-5;
  for (double stiffness : {1e4, 1e8, 1e12}) {
    SCOPED_TRACE(stiffness);
    Lattice lattice = test::lattice_of({spinning_bar(stiffness)});
    TimeOperator stepper = time(lattice);
    stepper.make_implicit(0);
    const test::Totals before = test::totals(lattice);
    const StepReport report = stepper.advance(20, kDt, kEmptySpace);
    EXPECT_EQ(report.broken_edges, 16u);  // 4 along and 12 across the middle cell
    EXPECT_EQ(report.splits.size(), 1u);
    const PieceMomenta left = momenta_of(lattice, false), right = momenta_of(lattice, true);
    stepper.advance(100, kDt, kEmptySpace);
    expect_near(momenta_of(lattice, false), left, stiffness > 1e6 ? 1e-12 : kFirstLoss);
    expect_near(momenta_of(lattice, true), right, stiffness > 1e6 ? 1e-12 : kFirstLoss);
    const test::Totals after = test::totals(lattice);
    EXPECT_LE(after.energy(), before.energy() * (1.0 + 1e-12));
    EXPECT_GE(after.energy(), before.energy() * (1.0 - 1e-3));
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-12 * before.momentum_scale);
    EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(),
              kFirstLoss * before.angular_momentum_scale);
  }
}

// ---- a soft ground

constexpr double kGroundStiffness = 1e9;  // N/m a point

Environment on_soft_ground() {
  Environment environment;
  environment.gravity = {0.0, -9.81, 0.0};
  environment.ground = Ground{.stiffness = kGroundStiffness, .damping = 1e3};
  return environment;
}

// J, without what the ground's springs hold: a point enters it by up to v dt before it is seen.
double energy_above(const Lattice& lattice) {
  double energy = test::totals(lattice).energy();
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    energy += 9.81 * lattice.mass[p] * lattice.motion[p].position.y();
  }
  return energy;
}

// Its stiffness does not bound the step: an explicit point would need 1.8 / sqrt(k / m) = 58 us.
// 64 points of a kilogram come to rest on the 16 below at m g / k each.
TEST_P(ImplicitObjects, RestOnASoftGroundAtTheirOwnStep) {
  const Environment earth = on_soft_ground();
  PhysicalModel stiff = block(1e9, 0.1, {0.0, 1e-3, 0.0}, "stiff");
  Lattice lattice = test::lattice_of({stiff});
  TimeOperator stepper = time(lattice);
  EXPECT_LT(stepper.largest_step(earth), 6e-5);
  stepper.make_implicit(0);
  const double dt = stepper.largest_step(earth);
  EXPECT_EQ(dt, stepper.largest_step());
  EXPECT_GT(dt, 100e-6);
  double highest = 0.0;
  const double start = energy_above(lattice);
  for (int n = 0; n < 300; ++n) {
    stepper.advance(1, 1e-3, earth);
    highest = std::max(highest, energy_above(lattice));
  }
  EXPECT_LE(highest, start * (1.0 + 1e-9));
  double below = 0.0;
  for (const PointMotion& m : lattice.motion) {
    EXPECT_LT(m.velocity.norm(), 1e-4);
    if (m.position.y() < 0.05) below += m.position.y();
  }
  EXPECT_NEAR(below, -64.0 * 9.81 / kGroundStiffness, 1e-3 * 64.0 * 9.81 / kGroundStiffness);
}

// The books of the ground: its impulse is what gravity did not do.
TEST_P(ImplicitObjects, GetTheImpulseThatASoftGroundBooks) {
  const Environment earth = on_soft_ground();
  PhysicalModel stiff = block(1e9, 0.1, {0.0, 1e-3, 0.0}, "stiff");
  set_in_motion(stiff, {0.0, -1.0, 0.0}, {0.0, 0.0, 0.5});
  Lattice lattice = test::lattice_of({stiff});
  TimeOperator stepper = time(lattice);
  stepper.make_implicit(0);
  const Vec3 before = test::totals(lattice).momentum;
  const StepReport report = stepper.advance(100, 1e-3, earth);
  const Vec3 weight(0.0, -9.81 * 64.0 * 0.1, 0.0);
  const Vec3 change = test::totals(lattice).momentum - before;
  EXPECT_GT(report.ground.impulse.y(), 64.0);
  EXPECT_LT((change - weight - report.ground.impulse).norm(), 1e-3 * report.ground.impulse.norm());
}

// What leaves by itself is not held: thrown upwards from within the ground it rises v^2 / (2 g).
TEST_P(ImplicitObjects, LeaveASoftGroundThatTheyAreThrownFrom) {
  const Environment earth = on_soft_ground();
  PhysicalModel stiff = block(1e9, 0.1, {0.0, -1e-6, 0.0}, "stiff");
  set_in_motion(stiff, {0.0, 2.0, 0.0}, Vec3::Zero());
  Lattice lattice = test::lattice_of({stiff});
  TimeOperator stepper = time(lattice);
  stepper.make_implicit(0);
  stepper.advance(200, 1e-3, earth);
  EXPECT_NEAR(test::totals(lattice).momentum.y(), 64.0 * (2.0 - 9.81 * 0.2), 1e-6 * 128.0);
}

// ---- objects that come later

// An implicit block flies on glued to another one, as a new object; the old one is idle.
PhysicalModel glued_to_another(const PhysicalModel& left) {
  PhysicalModel right = block(1e9, 0.1, {0.4, 0.0, 0.0}, "right");
  set_in_motion(right, {0.0, 1.0, 0.0}, {1.0, 1.0, 2.0});
  const GlueResult glued = glue(left, right, {.distance = 0.12, .stiffness = 1e9, .damping = 1e4});
  EXPECT_GE(glued.bonds, 16u);
  return glued.model;
}

TEST_P(ImplicitObjects, MayBeGluedAndAddedWhileOthersMove) {
  constexpr double kDt = 1e-3;
  PhysicalModel left = block(1e9, 0.1, {0.0, 0.0, 0.0}, "left");
  set_in_motion(left, {0.0, 1.0, 0.0}, {0.0, 1.0, 2.0});
  Lattice lattice = test::lattice_of({left, test::chain({.origin = {50.0, 0.0, 0.0}})});
  TimeOperator stepper = time(lattice);
  stepper.make_implicit(0);
  stepper.advance(3, kDt, kEmptySpace);
  const std::size_t added = add_object(lattice, glued_to_another(extract_model(lattice, 0)));
  const auto old_points = static_cast<std::size_t>(lattice.objects[0].points.end);
  std::fill_n(lattice.role.begin(), old_points, PointRole::kIdle);
  rebuild_active(lattice);
  stepper.roles_changed();
  EXPECT_FALSE(stepper.is_implicit(added));
  const double explicit_step = stepper.largest_step();
  stepper.make_implicit(added);
  EXPECT_GT(stepper.largest_step(), 5.0 * explicit_step);

  const std::vector<PointMotion> old(lattice.motion.begin(), lattice.motion.begin() + old_points);
  const test::Totals before = test::totals(lattice);
  stepper.advance(200, kDt, kEmptySpace);
  const test::Totals after = test::totals(lattice);
  test::expect_same_momenta(before, after, 1e-12);
  EXPECT_LE(after.energy(), before.energy());  // the two did not turn alike
  EXPECT_GT(after.energy(), 0.9 * before.energy());
  for (std::size_t p = 0; p < old.size(); ++p) {
    EXPECT_EQ(lattice.motion[p].position, old[p].position) << p;
  }
}

// An operator that is implicit as a whole takes what is added as it takes the rest.
TEST_P(ImplicitObjects, AreAllOfAnImplicitOperatorAlsoThoseAddedLater) {
  const PhysicalModel first = spinning_bar(1e10);
  PhysicalModel second = first;
  place(second, Mat3::Identity(), {10.0, 0.0, 0.0});
  Lattice both = test::lattice_of({first}), alone = test::lattice_of({second});
  TimeOperator of_both(both, Integrator::kImplicitEuler, GetParam());
  of_both.advance(1, 1e-3, kEmptySpace);
  add_object(both, second);
  rebuild_active(both);
  of_both.roles_changed();
  of_both.advance(50, 1e-3, kEmptySpace);
  TimeOperator(alone, Integrator::kImplicitEuler, GetParam()).advance(50, 1e-3, kEmptySpace);
  const auto offset = static_cast<std::size_t>(both.objects[1].points.begin);
  for (std::size_t p = 0; p < alone.motion.size(); ++p) {
    EXPECT_EQ(both.motion[offset + p].position, alone.motion[p].position) << p;
    EXPECT_EQ(both.motion[offset + p].velocity, alone.motion[p].velocity) << p;
  }
}

}  // namespace
}  // namespace limber
