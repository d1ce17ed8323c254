// Where the energy goes, and how large a step may be.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/dynamics/stable_step.h"
#include "core/model/errors.h"
#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

PhysicalModel unbreakable_block(std::array<int, 3> cells, double damping) {
  PhysicalModel model = test::block({.cells = cells});
  for (EdgeAttributes& e : model.edges) e.damping = damping, e.break_threshold = kUnbreakable;
  return model;
}

Lattice shaken_block(std::array<int, 3> cells, double damping) {
  Lattice lattice = test::lattice_of({unbreakable_block(cells, damping)});
  test::shake(lattice, 61, 0.05);
  return lattice;
}

struct EnergyRange {
  double mean = 0.0, least = 1e300, most = 0.0;
};

EnergyRange energies(Lattice& lattice, TimeOperator& time, int samples, double dt) {
  EnergyRange range;
  for (int n = 0; n < samples; ++n) {
    time.advance(7, dt, kEmptySpace);  // no multiple of a period
    const double energy = test::totals(lattice).energy();
    range.mean += energy / samples;
    range.least = std::min(range.least, energy);
    range.most = std::max(range.most, energy);
  }
  return range;
}

// The quadratic form that the integrator keeps exactly for linear springs,
// v.Mv + x.Kx - dt v.Kx, lies within a factor 1 +- omega dt / 2 of twice the energy.
TEST(Energy, OfAnUndampedLatticeIsBoundedAndDoesNotDriftOver100000Steps) {
  constexpr double kShare = 0.5;  // of the limit 2 / omega_max, so that omega dt / 2 <= 0.5
  Lattice lattice = shaken_block({2, 2, 2}, 0.0);
  const double start = test::totals(lattice).energy();
  TimeOperator time(lattice);
  const double dt = kShare * 2.0 / highest_frequency(lattice.objects[0].authored).omega_max;
  const EnergyRange first = energies(lattice, time, 2000, dt);
  time.advance(100000 - 2 * 14000, dt, kEmptySpace);
  const EnergyRange last = energies(lattice, time, 2000, dt);
  EXPECT_NEAR(last.mean, first.mean, 0.01 * first.mean);
  EXPECT_GT(std::min(first.least, last.least), start / (1.0 + kShare) * 0.95);
  EXPECT_LT(std::max(first.most, last.most), start / (1.0 - kShare) * 1.05);
}

// dE/dt = -sum c (dL/dt)^2.
double damping_power(const Lattice& lattice) {
  double power = 0.0;
  for (const Spring& s : lattice.springs) {
    const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
    const double rate =
        d.normalized().dot(lattice.motion[s.b].velocity - lattice.motion[s.a].velocity);
    power += s.damping * rate * rate;
  }
  return power;
}

TEST(Energy, LostBySpringDampingIsItsWork) {
  Lattice lattice = shaken_block({2, 1, 1}, 2.0);
  TimeOperator time(lattice);
  const double dt = 0.001 * time.largest_step();
  double last = test::totals(lattice).energy(), work = 0.0;
  const double start = last;
  for (int n = 0; n < 200; ++n) {
    for (int i = 0; i < 50; ++i) {
      work += damping_power(lattice) * dt;
      time.advance(1, dt, kEmptySpace);
    }
    const double now = test::totals(lattice).energy();
    EXPECT_LT(now, last) << "sample " << n;
    last = now;
  }
  EXPECT_GT(start - last, 0.5 * start);
  EXPECT_NEAR(work, start - last, 0.01 * start);
}

TEST(Energy, LostByInternalDampingIsReported) {
  PhysicalModel model = unbreakable_block({2, 2, 2}, 0.0);
  model.object.internal_damping = 5.0;
  Lattice lattice = test::lattice_of({model});
  test::shake(lattice, 62, 0.05);
  const double start = test::totals(lattice).energy();
  TimeOperator time(lattice);
  const double dt = 0.01 * time.largest_step();
  const StepReport report = time.advance(8000, dt, kEmptySpace);
  const double lost = start - test::totals(lattice).energy();
  EXPECT_GT(lost, 0.3 * start);
  EXPECT_NEAR(report.damped_J, lost, 0.01 * start);
}

// ---------------------------------------------------------------------------------------------

TEST(LargestStep, IsStable) {
  for (double damping : {0.0, 0.5, 5.0, 50.0}) {
    Lattice lattice = shaken_block({3, 2, 2}, damping);
    const double start = test::totals(lattice).energy();
    TimeOperator time(lattice);
    time.advance(20000, time.largest_step(), kEmptySpace);
    // Undamped, the highest modes' energy swings by the factor 1 / (1 - 0.92) at most.
    EXPECT_LT(test::totals(lattice).energy(), (damping == 0.0 ? 13.0 : 1.0) * start)
        << "damping " << damping;
  }
}

TEST(LargestStep, IsThatOfTheStiffestDynamicObject) {
  Lattice lattice =
      test::lattice_of({test::chain({.points = 3}),
                        test::chain({.points = 3, .stiffness = 1e4, .origin = {0.0, 5.0, 0.0}})});
  TimeOperator time(lattice);
  EXPECT_EQ(time.largest_step(), lattice.objects[1].largest_step);
  for (std::int32_t p : {3, 4, 5}) lattice.role[p] = PointRole::kIdle;
  rebuild_active(lattice);
  EXPECT_EQ(time.largest_step(), lattice.objects[0].largest_step);
}

// 2 / omega for the dumbbell of 100 N/m and 1 kg: omega = sqrt(2 k / m).
TEST(LargestStep, ExceededByAThirdBlowsUpWithTheNameOfObjectAndPoint) {
  PhysicalModel calm = test::chain({.points = 3, .stiffness = 1.0, .name = "calm"});
  PhysicalModel wild = test::chain({.points = 2, .origin = {0.0, 9.0, 0.0}, .name = "wild"});
  wild.points[PointId(1)].velocity = {0.01, 0.0, 0.0};
  Lattice lattice = test::lattice_of({calm, wild});
  TimeOperator time(lattice);
  const double limit = 2.0 / std::sqrt(2.0 * 100.0);
  try {
    time.advance(5000, 1.3 * limit, kEmptySpace);
    FAIL() << "no SimulationError";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.diagnostic.where, testing::StartsWith("wild: point "));
    EXPECT_THAT(error.diagnostic.where, testing::MatchesRegex(".*point [01]"));
    EXPECT_FALSE(error.diagnostic.remedy.empty());
  }
}

TEST(LargestStep, IsCloseToTheLimit) {
  Lattice lattice = test::lattice_of({test::chain({.points = 2})});
  const double limit = 2.0 / std::sqrt(2.0 * 100.0);
  lattice.motion[1].velocity = {0.01, 0.0, 0.0};
  TimeOperator time(lattice);
  time.advance(20000, 0.99 * limit, kEmptySpace);
  EXPECT_LT(test::totals(lattice).kinetic, 1.0);
  EXPECT_LT(time.largest_step(), limit);
}

}  // namespace
}  // namespace limber
