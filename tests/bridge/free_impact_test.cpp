#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/substep_reference.h"
#include "tests/bridge/world.h"

// A lattice of 8 kg hits a free box off its centre at 10 m/s. Momentum alone would not do: a box
// held still for a tick keeps it exact and gains twenty times the energy.

namespace limber::bullet::test {
namespace {

constexpr double kSpeed = 10.0;           // m/s
constexpr double kSubstep = kTick / 256;  // s
constexpr double kSeconds = 7.0 * kTick;
const Vec3 kLatticeStart(0.12, 0.6 + 0.15 + 0.2, 0.05);

struct Impact {
  World world;
  btRigidBody* box = nullptr;
  PhysicalModel model;

  Impact(double box_mass, double gravity) : world(gravity) {
    box = &world.add_box(Vec3::Constant(0.3), box_mass, {0.0, 0.3, 0.0});
    box->setActivationState(DISABLE_DEACTIVATION);
    model = make_block({}, kLatticeStart, {0.0, -kSpeed, 0.0});
  }
};

struct Result {
  Sums box, lattice;
  double most_energy = 0.0;  // J, without gravity
  Sums both() const {
    Sums sum = box;
    return sum += lattice;
  }
};

Result limbers(double box_mass, double tick, double gravity = 0.0) {
  Impact impact(box_mass, gravity);
  const double scale = step_scale_for(impact.model, kSubstep);
  CoSimulation simulation(*impact.world, settings_for(Representation::kAlwaysFlexible, scale));
  simulation.add(impact.model);
  Result result;
  for (double t = 0.5 * tick; t < kSeconds; t += tick) {
    impact.world.step(tick);
    EXPECT_FALSE(simulation.failure());
    result.box = sums_of(*impact.box);
    result.lattice = sums_of(simulation.model(0));
    result.most_energy = std::max(result.most_energy, result.both().energy(0.0));
  }
  return result;
}

Result at_the_substep_rate(double box_mass) {
  Impact impact(box_mass, 0.0);
  SubstepReference reference(impact.world, impact.model);
  for (double t = 0.5 * kSubstep; t < kSeconds; t += kSubstep) reference.step(kSubstep);
  return {sums_of(*impact.box), sums_of(reference.model()), 0.0};
}

class FreeImpact : public testing::TestWithParam<double> {};

TEST_P(FreeImpact, KeepsMomentumAndAngularMomentum) {
  Impact start(GetParam(), 0.0);
  const Sums before = sums_of(start.model);
  for (double tick : {kTick, kTick / 4.0}) {
    const Result result = limbers(GetParam(), tick);
    EXPECT_GT(result.box.momentum.norm(), 1.0) << "nothing was hit";
    const Sums after = result.both();
    const double tolerance = by_precision(1e-5, 1e-12);
    EXPECT_LT((after.momentum - before.momentum).norm(), tolerance * before.momentum.norm());
    const double scale = before.momentum.norm() * kLatticeStart.norm();
    EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(), tolerance * scale);
  }
}

TEST_P(FreeImpact, NeverGainsEnergyAndEndsWithThatOfTheReference) {
  const double start = 0.5 * 8.0 * kSpeed * kSpeed;
  const double reference = at_the_substep_rate(GetParam()).both().energy(0.0);
  for (double tick : {kTick, kTick / 4.0}) {
    const Result result = limbers(GetParam(), tick);
    // Semi-implicit Euler lets the springs' energy oscillate about the true one: 0.1 %.
    EXPECT_LE(result.most_energy, start * 1.001);
    EXPECT_NEAR(result.both().energy(0.0), reference, 0.005 * start) << "tick " << tick;
  }
}

TEST_P(FreeImpact, GivesTheVelocitiesOfTheReference) {
  const Result reference = at_the_substep_rate(GetParam());
  const Result result = limbers(GetParam(), kTick);
  EXPECT_LT((result.box.velocity() - reference.box.velocity()).norm(), 0.01 * kSpeed);
  EXPECT_LT((result.lattice.velocity() - reference.lattice.velocity()).norm(), 0.01 * kSpeed);
}

// The substeps are the same ones; only how often Bullet looks in between differs.
TEST_P(FreeImpact, DoesNotDependOnTheTick) {
  const Result coarse = limbers(GetParam(), kTick), fine = limbers(GetParam(), kTick / 4.0);
  const double tolerance = by_precision(1e-3, 1e-6);
  EXPECT_LT((coarse.box.velocity() - fine.box.velocity()).norm(), tolerance * kSpeed);
  EXPECT_LT((coarse.box.centre() - fine.box.centre()).norm(), tolerance);
  EXPECT_LT((coarse.lattice.velocity() - fine.lattice.velocity()).norm(), tolerance * kSpeed);
}

// Bullet adds a tick of gravity to the box by itself: it must have fallen neither twice nor not at
// all.
TEST_P(FreeImpact, UnderGravityGainsItsImpulseAndNothingElse) {
  Impact start(GetParam(), 0.0);
  const Sums before = sums_of(start.model);
  const Sums after = limbers(GetParam(), kTick, kGravity).both();
  const Vec3 gained(0.0, -kGravity * after.mass * kSeconds, 0.0);
  const double tolerance = by_precision(1e-5, 1e-12);
  EXPECT_LT((after.momentum - before.momentum - gained).norm(),
            tolerance * (before.momentum.norm() + gained.norm()));
}

INSTANTIATE_TEST_SUITE_P(BoxMasses, FreeImpact, testing::Values(2.0, 20.0, 200.0));

}  // namespace
}  // namespace limber::bullet::test
