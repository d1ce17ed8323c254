// What pinned points carry: lattice.force, against statics.

#include <gtest/gtest.h>

#include <optional>

#include "core/analysis/equilibrium.h"
#include "core/operators/time_operator.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kG = 9.81;           // m/s^2
constexpr double kStiffness = 100.0;  // N/m
constexpr double kSettle = 20.0;      // s, of motions that die as exp(-10 t) or faster
constexpr double kDt = 1e-3;          // s

// Points of 1 kg, 1 m apart, down from a pin at the origin.
PhysicalModel hanging_chain(int points) {
  PhysicalModel model =
      test::chain({.points = points, .stiffness = kStiffness, .along = -Vec3::UnitY()});
  model.points[PointId(0)].pinned = true;
  for (EdgeAttributes& edge : model.edges) edge.damping = 20.0;
  return model;
}

Environment with_gravity(std::optional<Ground> ground = {}) {
  return {.gravity = {0.0, -kG, 0.0}, .ground = ground};
}

// The force of the ground in the last substep, N.
Vec3 come_to_rest(Lattice& lattice, const Environment& environment, Integrator integrator) {
  TimeOperator time(lattice, integrator);
  time.advance(static_cast<int>(kSettle / kDt), kDt, environment);
  return time.advance(1, kDt, environment).ground.impulse / kDt;
}

class PinnedPoints : public testing::TestWithParam<Integrator> {};

// The spring below point i bears all that hangs on it.
TEST_P(PinnedPoints, CarryTheWeightOfAHangingChain) {
  PhysicalModel model = hanging_chain(5);
  const double mass[] = {0.5, 1.0, 2.0, 0.25, 1.5};
  for (PointId p : ids_of(model.points)) model.points[p].mass = mass[p.value];
  Lattice lattice = test::lattice_of({model});
  come_to_rest(lattice, with_gravity(), GetParam());
  EXPECT_EQ(lattice.motion[0].position, Vec3::Zero());
  EXPECT_LT((lattice.force[0] - Vec3(0.0, -5.25 * kG, 0.0)).norm(), 1e-6);
  double hangs = 5.25;
  for (int i = 1; i < 5; ++i) {
    hangs -= mass[i - 1];
    const double stretch = (lattice.motion[i - 1].position - lattice.motion[i].position).norm() - 1;
    EXPECT_NEAR(stretch, hangs * kG / kStiffness, 1e-8);
  }
}

// A chain slung between two pins, in its equilibrium: half of the weight each, drawn towards each
// other by what the sagging links pull sideways, the same in all of them.
TEST_P(PinnedPoints, ShareTheWeightOfASlungChain) {
  PhysicalModel model = test::chain({.points = 7, .stiffness = kStiffness});
  for (int i : {0, 6}) model.points[PointId(std::size_t(i))].pinned = true;
  for (int i = 1; i < 6; ++i) model.geometry.points[PointId(std::size_t(i))].y() = -0.2;
  ASSERT_TRUE(settle(model, {0.0, -kG, 0.0}).converged);
  Lattice lattice = test::lattice_of({model});
  TimeOperator(lattice, GetParam()).advance(1, kDt, with_gravity());
  const Vec3 link = model.geometry.points[PointId(4)] - model.geometry.points[PointId(3)];
  const double sideways = kStiffness * (link.norm() - 1.0) * link.x() / link.norm();
  EXPECT_GT(sideways, 10.0);
  EXPECT_LT((lattice.force[0] - Vec3(sideways, -3.5 * kG, 0.0)).norm(), 1e-6);
  EXPECT_LT((lattice.force[6] - Vec3(-sideways, -3.5 * kG, 0.0)).norm(), 1e-6);
}

// The end just touches a hard ground: the lower spring stays as long as it is, so that the middle
// point hangs on two springs of k, each with half of its weight.
TEST_P(PinnedPoints, ShareTheWeightWithAHardGround) {
  Lattice lattice = test::lattice_of({hanging_chain(3)});
  const Vec3 ground = come_to_rest(lattice, with_gravity(Ground{.height = -2.0}), GetParam());
  EXPECT_LT((lattice.force[0] - Vec3(0.0, -1.5 * kG, 0.0)).norm(), 1e-6);
  EXPECT_LT((ground - Vec3(0.0, 1.5 * kG, 0.0)).norm(), 1e-6);
  EXPECT_NEAR(lattice.motion[1].position.y(), -1.0 - 0.5 * kG / kStiffness, 1e-8);
}

// A ground as stiff as the springs: both points sink by m g / k, and each of the three bears m g
// (the pin its own weight too).
TEST_P(PinnedPoints, ShareTheWeightWithASoftGround) {
  Ground soft{.height = -2.0, .stiffness = kStiffness, .damping = 20.0};
  Lattice lattice = test::lattice_of({hanging_chain(3)});
  const Vec3 ground = come_to_rest(lattice, with_gravity(soft), GetParam());
  EXPECT_LT((lattice.force[0] - Vec3(0.0, -2.0 * kG, 0.0)).norm(), 1e-6);
  EXPECT_LT((ground - Vec3(0.0, kG, 0.0)).norm(), 1e-6);
  for (int i : {1, 2}) {
    EXPECT_NEAR(lattice.motion[i].position.y(), -i - kG / kStiffness, 1e-8);
  }
}

// A pin in the ground: a soft ground presses on it, a hard one leaves it to the pin. Neither moves
// it.
TEST_P(PinnedPoints, InTheGroundCarryWhatItLeaves) {
  PhysicalModel model = test::chain({.points = 1, .mass = 2.0, .origin = {0.0, -0.03, 0.0}});
  model.points[PointId(0)].pinned = true;
  for (double stiffness : {kStiffness, kUnbreakable}) {
    Lattice lattice = test::lattice_of({model});
    const Ground ground{.stiffness = stiffness, .static_friction = 0.5, .kinetic_friction = 0.5};
    const double press = stiffness == kStiffness ? 0.03 * kStiffness : 0.0;
    const Vec3 felt = come_to_rest(lattice, with_gravity(ground), GetParam());
    EXPECT_EQ(lattice.motion[0].position, Vec3(0.0, -0.03, 0.0));
    EXPECT_LT((lattice.force[0] - Vec3(0.0, press - 2.0 * kG, 0.0)).norm(), 1e-12);
    EXPECT_LT((felt - Vec3(0.0, press, 0.0)).norm(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, PinnedPoints,
                         testing::Values(Integrator::kSymplecticEuler, Integrator::kRungeKutta4),
                         [](const auto& of) { return of.index == 0 ? "Euler" : "RungeKutta"; });

}  // namespace
}  // namespace limber
