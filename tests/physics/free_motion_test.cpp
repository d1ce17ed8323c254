// Without contact: free fall and free rotation.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

using std::numbers::pi;

const Vec3 kGravity(0.0, -9.81, 0.0);

// Semi-implicit Euler falls g dt^2 (1 + 2 + ... + n) = g t^2 / 2 + g t dt / 2: the parabola and
// exactly that offset.
TEST(FreeFall, IsTheParabolaWithTheOffsetOfTheIntegrator) {
  constexpr int kSteps = 500;
  constexpr double kStep = 1e-3, t = kSteps * kStep;
  PhysicalModel model = test::block({.cells = {1, 2, 1}});
  model.object.internal_damping = 10.0;  // must not hold it back
  set_in_motion(model, {1.0, 2.0, 3.0}, Vec3::Zero());
  Lattice lattice = test::lattice_of({model});
  TimeOperator(lattice).advance(kSteps, kStep, {.gravity = kGravity});
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    const Vec3 wanted = lattice.authored_position[p] + Vec3(1.0, 2.0, 3.0) * t +
                        0.5 * kGravity * t * t + 0.5 * kGravity * t * kStep;
    EXPECT_LE((lattice.motion[p].position - wanted).norm(), 1e-12);
    EXPECT_LE((lattice.motion[p].velocity - Vec3(1.0, 2.0, 3.0) - kGravity * t).norm(), 1e-12);
  }
}

// Away from the origin, uneven, turning about no principal axis, damped in both ways.
TEST(FreeRotation, KeepsMomentumAndAngularMomentum) {
  PhysicalModel model = test::block({.cells = {2, 1, 3}, .origin = {3.0, 2.0, -1.0}});
  int i = 0;
  for (PointAttributes& p : model.points) p.mass = 0.5 + (i++ * 7 % 11) / 5.0;
  for (EdgeAttributes& e : model.edges) e.break_threshold = kUnbreakable;
  model.object.internal_damping = 0.5;
  set_in_motion(model, {0.3, -0.2, 0.1}, {1.0, 2.0, -1.5});
  Lattice lattice = test::lattice_of({model});
  TimeOperator time(lattice);
  const test::Totals before = test::totals(lattice);
  time.advance(10000, 0.2 * time.largest_step(), kEmptySpace);
  test::expect_same_momenta(before, test::totals(lattice), 1e-12);
}

// A cube of 27 points of 1 kg, 1 m apart: I = sum (x^2 + y^2) = 18 + 18 = 36 kg m^2 about any axis
// through its centre, so that L gives the period 2 pi I / L.
double angle_about_z(const Lattice& lattice) {
  const Mat3 turned = best_rotation(lattice.motion, lattice.authored_position, lattice.mass,
                                    lattice.dynamic_points);
  return std::atan2(turned(1, 0), turned(0, 0));
}

TEST(FreeRotation, TurnsWithLOverI) {
  constexpr double kOmega = 2.0;  // rad/s
  PhysicalModel model = test::block({.cells = {2, 2, 2}});
  for (EdgeAttributes& e : model.edges) e.stiffness = 1e6, e.damping = 100.0;
  set_in_motion(model, Vec3::Zero(), {0.0, 0.0, kOmega});
  Lattice lattice = test::lattice_of({model});
  EXPECT_NEAR(test::totals(lattice).angular_momentum.z(), 36.0 * kOmega, 1e-12);
  TimeOperator time(lattice);
  const double quarter = 2.0 * pi * 36.0 / (36.0 * kOmega) / 4.0;
  const int steps = static_cast<int>(std::ceil(quarter / time.largest_step()));
  // The centrifugal strain, about m omega^2 / k = 4e-6, slows it down by twice as much.
  for (double wanted : {pi / 2.0, pi, -pi / 2.0, 0.0}) {
    time.advance(steps, quarter / steps, kEmptySpace);
    const double off = std::remainder(angle_about_z(lattice) - wanted, 2.0 * pi);
    EXPECT_NEAR(off, 0.0, 2e-4);
  }
}

}  // namespace
}  // namespace limber
