// ImplicitEuler over many steps: closed forms, conserved quantities, other methods.

#include "core/dynamics/implicit_euler.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/analysis/equilibrium.h"
#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/implicit_run.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

// Two points of 1 kg on a line: reduced mass 1/2 kg.
Lattice oscillator(double omega, double zeta, double stretch) {
  PhysicalModel model = test::chain({.points = 2, .stiffness = 0.5 * omega * omega});
  model.edges[EdgeId(0)].damping = zeta * omega;  // 2 zeta omega m
  model.geometry.points[PointId(1)].x() += stretch;
  return test::lattice_of({model});
}

double stretch_of(const Lattice& lattice) {
  return (lattice.motion[1].position - lattice.motion[0].position).norm() - 1.0;
}

// w1 = (w0 - dt omega^2 s0) / (1 + 2 zeta omega dt + (omega dt)^2), s1 = s0 + dt w1: from far below
// the explicit limit, omega dt = 2, to far above it.
TEST(ImplicitOscillator, FollowsTheExactSolutionOfBackwardEuler) {
  constexpr double kOmega = 50.0;
  for (double z : {0.01, 0.5, 2.0, 10.0, 1e3}) {
    for (double zeta : {0.0, 0.3, 10.0}) {
      Lattice lattice = oscillator(kOmega, zeta, 0.1);
      const double dt = z / kOmega;
      double s = 0.1, w = 0.0;
      for (int n = 0; n < 100; ++n) {
        test::run_implicit(lattice, 1, dt);
        w = (w - dt * kOmega * kOmega * s) / (1.0 + 2.0 * zeta * z + z * z);
        s += dt * w;
        ASSERT_NEAR(stretch_of(lattice), s, 1e-11) << z << " " << zeta << " step " << n;
      }
    }
  }
}

// |amplification| = (1 + (omega dt)^2)^(-1/2) of s and w / omega together.
TEST(ImplicitOscillator, DecaysAsTheAmplificationFactorSays) {
  constexpr double kOmega = 50.0;
  for (double z : {0.1, 1.9, 2.1, 30.0}) {
    Lattice lattice = oscillator(kOmega, 0.0, 0.1);
    const double before = test::totals(lattice).energy();
    test::run_implicit(lattice, 3, z / kOmega);
    const double wanted = std::pow(1.0 + z * z, -3.0);
    EXPECT_NEAR(test::totals(lattice).energy() / before, wanted, 1e-9 * wanted) << z;
  }
}

TEST(ImplicitFall, IsThatOfSemiImplicitEuler) {
  const Environment gravity{.gravity = {0.0, -9.8, 0.0}};
  PhysicalModel model = test::block({.cells = {2, 2, 2}, .origin = {3.0, 50.0, 1.0}});
  set_in_motion(model, {2.0, 5.0, 1.0}, Vec3::Zero());
  Lattice implicit = test::lattice_of({model}), symplectic = implicit;
  test::run_implicit(implicit, 120, 1.0 / 60, {}, gravity.gravity);
  TimeOperator(symplectic).advance(120, 1.0 / 60, gravity);
  for (std::size_t p = 0; p < implicit.motion.size(); ++p) {
    EXPECT_LT((implicit.motion[p].position - symplectic.motion[p].position).norm(), 1e-12);
    EXPECT_LT((implicit.motion[p].velocity - symplectic.motion[p].velocity).norm(), 1e-12);
  }
}

// Two points on a stiff rod: the angle turned in a step is atan(omega dt), L falls by its cosine.
TEST(ImplicitSpin, WithoutHelpSlowsAsBackwardEulerDoes) {
  constexpr double kDt = 1.0 / 60, kSpin = 6.0;
  PhysicalModel model = test::chain({.points = 2, .stiffness = 1e10});
  set_in_motion(model, Vec3::Zero(), {0.0, 0.0, kSpin});
  Lattice lattice = test::lattice_of({model});
  const double before = test::totals(lattice).angular_momentum.z();
  test::run_implicit(lattice, 1, kDt, {.newton_tolerance = 1e-12, .restore_spin = false});
  const double wanted = 1.0 / std::hypot(1.0, kSpin * kDt);
  // L is about the origin, and the centre rests: the same about both.
  EXPECT_NEAR(test::totals(lattice).angular_momentum.z() / before, wanted, 1e-9);
}

// A rod that spins for 10 s, in steps of 0.1 rad. The first step loses the share (omega dt)^2 / 8
// of L, since the end of a chord moves outwards and that takes energy; no other does. The strain is
// m omega^2 r / k, not the (omega dt)^2 / 2 = 0.5 % of a step along the tangent.
TEST(ImplicitSpin, WithHelpLasts) {
  constexpr double kSpin = 6.0, kStiffness = 1e6;
  PhysicalModel model = test::chain({.points = 2, .stiffness = kStiffness});
  model.edges[EdgeId(0)].damping = 100.0;
  set_in_motion(model, Vec3::Zero(), {0.0, 0.0, kSpin});
  Lattice lattice = test::lattice_of({model});
  const test::Totals before = test::totals(lattice);
  test::run_implicit(lattice, 600, 1.0 / 60);
  const test::Totals after = test::totals(lattice);
  const double lost = 1.0 - after.angular_momentum.z() / before.angular_momentum.z();
  const double wanted = std::pow(kSpin / 60.0, 2) / 8.0;
  EXPECT_NEAR(lost, wanted, 0.02 * wanted);
  EXPECT_NEAR(after.energy() / before.energy(), 1.0, 1e-4);
  EXPECT_NEAR(stretch_of(lattice), 0.5 * kSpin * kSpin / kStiffness, 2e-2 * 18e-6);
}

// In any motion at all, whatever the stiffness, damping and speed.
TEST(ImplicitBlock, NeverGainsEnergyAndKeepsMomenta) {
  unsigned seed = 0;
  for (double stiffness : {1.0, 1e4, 1e8, 1e12}) {
    for (double zeta : {0.0, 0.3, 100.0}) {
      for (double speed : {0.1, 30.0}) {
        PhysicalModel model = test::block({.cells = {2, 2, 1}});
        for (EdgeAttributes& e : model.edges) {
          e.stiffness = stiffness;
          e.damping = 2.0 * zeta * std::sqrt(stiffness);
        }
        Lattice lattice = test::lattice_of({model});
        test::shake(lattice, ++seed, speed);
        std::mt19937 random(seed);
        for (PointMotion& m : lattice.motion) m.position += test::random_vector(random, 0.2);
        const test::Totals start = test::totals(lattice);
        ImplicitEuler euler;
        double energy = start.energy();
        for (int n = 0; n < 60; ++n) {
          test::take_forces(lattice);
          EXPECT_TRUE(euler.step(lattice, lattice.dynamic_points, 1.0 / 60).converged);
          const double now = test::totals(lattice).energy();
          ASSERT_LE(now, energy + 1e-10 * start.energy())
              << stiffness << " N/m, " << zeta << ", " << speed << " m/s, step " << n;
          energy = now;
        }
        // What rounding of the forces, up to 0.2 m k, leaves in their sums.
        const double rounding = 1e-13 + 1e-16 * stiffness / speed;
        EXPECT_LE((test::totals(lattice).momentum - start.momentum).norm(),
                  rounding * start.momentum_scale);
      }
    }
  }
}

// A damped block in large vibration.
double error_of(int steps, const std::vector<PointMotion>& wanted, Lattice lattice) {
  test::run_implicit(lattice, steps, 0.25 / steps);
  double error = 0.0;
  for (std::size_t p = 0; p < wanted.size(); ++p) {
    error = std::max(error, (lattice.motion[p].position - wanted[p].position).norm());
  }
  return error;
}

TEST(ImplicitBlock, ConvergesToRungeKuttaWithFirstOrder) {
  PhysicalModel model = test::uneven_block({2, 1, 1});
  for (EdgeAttributes& e : model.edges) e.break_threshold = kUnbreakable;
  Lattice start = test::lattice_of({model});
  test::shake(start, 51, 1.0);
  Lattice reference = start;
  TimeOperator(reference, Integrator::kRungeKutta4).advance(4000, 0.25 / 4000, kEmptySpace);
  const double coarse = error_of(1000, reference.motion, start);
  const double fine = error_of(2000, reference.motion, start);
  EXPECT_NEAR(coarse / fine, 2.0, 0.1);
  EXPECT_LT(fine, 2e-3);
}

// A cantilever that bends by a tenth of its length: 300 steps that are ten thousand times the
// explicit limit end where Newton's method finds the least energy.
TEST(ImplicitBlock, ComesToRestInEquilibrium) {
  const Vec3 gravity(0.0, -9.8, 0.0);
  PhysicalModel model = test::block({.cells = {8, 1, 1}});
  for (EdgeAttributes& e : model.edges) e.stiffness = 4e4, e.break_threshold = kUnbreakable;
  for (PointId p : ids_of(model.points)) {
    model.points[p].pinned = model.geometry.points[p].x() == 0.0;
  }
  Lattice lattice = test::lattice_of({model});
  test::run_implicit(lattice, 300, 10.0, {}, gravity);
  ASSERT_TRUE(settle(model, gravity).converged);
  double sag = 0.0;
  for (PointId p : ids_of(model.points)) {
    const Vec3& found = lattice.motion[p.index()].position;
    EXPECT_LT((found - model.geometry.points[p]).norm(), 1e-9);
    sag = std::max(sag, lattice.authored_position[p.index()].y() - found.y());
  }
  EXPECT_GT(sag, 0.2);
}

// Coincident points, springs of no length, masses of a millionth and a million: finite, and no
// gain.
TEST(ImplicitDegenerates, StayFinite) {
  for (double ratio : {1e-6, 1e6}) {
    for (double stiffness : {1e-2, 1e6, 1e12}) {
      PhysicalModel model = test::block({.cells = {1, 1, 2}});
      for (EdgeAttributes& e : model.edges) e.stiffness = stiffness, e.damping = 0.0;
      for (std::size_t i = 0; i < model.points.size(); i += 2)
        model.points[PointId(i)].mass = ratio;
      Lattice lattice = test::lattice_of({model});
      lattice.springs[0].rest_length = 0.0;
      lattice.active[lattice.active_of_edge[0]].rest_length = 0.0;
      for (std::size_t p = 0; p < 4; ++p) lattice.motion[p].position = Vec3(1.0, 2.0, 3.0);
      test::shake(lattice, 7, 1.0);
      const double before = test::totals(lattice).energy();
      test::run_implicit(lattice, 60, 1.0 / 60);
      for (const PointMotion& m : lattice.motion) {
        EXPECT_TRUE(m.position.allFinite() && m.velocity.allFinite());
      }
      EXPECT_LE(test::totals(lattice).energy(), before * (1.0 + 1e-10));
    }
  }
}

}  // namespace
}  // namespace limber
