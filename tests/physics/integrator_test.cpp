// Order and growth of the integrators, on a spring that swings.

#include <gtest/gtest.h>

#include <cmath>

#include "core/operators/time_operator.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kOmega = 14.142135623730951;  // rad/s, of two points of 1 kg on 100 N/m

// A dumbbell stretched by 5 % that also turns, so that the problem is not linear.
Lattice dumbbell(double spin) {
  PhysicalModel model = test::chain({.points = 2});
  model.geometry.points[PointId(std::size_t{1})].x() += 0.05;
  set_in_motion(model, Vec3::Zero(), {0.0, 0.0, spin});
  return test::lattice_of({model});
}

Vec3 end_after(Integrator integrator, double dt, double seconds) {
  Lattice lattice = dumbbell(2.0);
  TimeOperator(lattice, integrator)
      .advance(static_cast<int>(std::lround(seconds / dt)), dt, kEmptySpace);
  return lattice.motion[1].position;
}

// How the error shrinks when the step is halved.
double error_ratio(Integrator integrator, double dt) {
  const Vec3 exact = end_after(Integrator::kRungeKutta4, 1e-5, 1.0);
  return (end_after(integrator, dt, 1.0) - exact).norm() /
         (end_after(integrator, dt / 2, 1.0) - exact).norm();
}

TEST(Integrators, HaveTheirOrder) {
  EXPECT_NEAR(error_ratio(Integrator::kRungeKutta4, 0.01), 16.0, 1.0);
  EXPECT_NEAR(error_ratio(Integrator::kSymplecticEuler, 1e-3), 2.0, 0.1);
  EXPECT_NEAR(error_ratio(Integrator::kExplicitEuler, 1e-4), 2.0, 0.1);
}

// |R(i omega dt)|: sqrt(1 + (omega dt)^2) and, for the classical method, the modulus of its
// stability polynomial.
TEST(Integrators, GrowAsTheirStabilityPolynomial) {
  const double dt = 0.02, z = kOmega * dt;
  const auto growth = [&](Integrator integrator) {
    Lattice lattice = dumbbell(0.0);
    const double before = test::totals(lattice).energy();
    TimeOperator(lattice, integrator).advance(20, dt, kEmptySpace);
    return std::pow(test::totals(lattice).energy() / before, 1.0 / 40.0);
  };
  EXPECT_NEAR(growth(Integrator::kExplicitEuler), std::sqrt(1.0 + z * z), 1e-9);
  const double real = 1.0 - z * z / 2.0 + z * z * z * z / 24.0;
  const double imaginary = z - z * z * z / 6.0;
  EXPECT_NEAR(growth(Integrator::kRungeKutta4), std::hypot(real, imaginary), 1e-12);
}

// The coupling is asked once a substep whatever the integrator, and pushes all through it.
TEST(Integrators, GiveACouplingsImpulseInFull) {
  class Push : public SubstepCoupling {
   public:
    void add_forces(Lattice& lattice, double) override { lattice.force[0].x() += 3.0; }
    void advance(Lattice&, double) override {}
  };
  for (Integrator integrator : {Integrator::kSymplecticEuler, Integrator::kExplicitEuler,
                                Integrator::kRungeKutta4}) {
    Lattice lattice = test::lattice_of({test::chain({.points = 2})});
    Push push;
    TimeOperator(lattice, integrator).advance(100, 1e-3, kEmptySpace, &push);
    EXPECT_NEAR(test::totals(lattice).momentum.x(), 0.3, 1e-12);
  }
}

}  // namespace
}  // namespace limber
