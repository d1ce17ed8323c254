#include "core/analysis/oscillator_recurrence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace limber {
namespace {

// The first that integrates so, in double precision.
Scheme scheme_of(Integrator integrator) {
  for (const Scheme& scheme : schemes()) {
    if (scheme.integrator == integrator) return scheme;
  }
  return {};
}

// tests/data/reference_cases.json, G04.numerical_frequency.p0 and .p1: a dumbbell of omega =
// 14.142135623730951 rad/s.
TEST(OscillatorRecurrence, HasTheFrequencyOfIndependentNumbers) {
  const double omega = 14.142135623730951;
  const struct {
    double dt, symplectic, runge_kutta, runge_kutta_factor;
  } cases[] = {{0.01414213562373095, 14.165812551461563, 14.1419497486044, 0.99999955777768},
               {0.07071067811865475, 14.809609793861222, 14.063238151033469, 0.9939050368230469}};
  for (const auto& [dt, symplectic, runge_kutta, factor] : cases) {
    const auto of = [&, dt = dt](Integrator integrator) {
      return measured_recurrence(scheme_of(integrator), 0.0, omega * dt);
    };
    EXPECT_NEAR(of(Integrator::kSymplecticEuler).angle() / dt, symplectic, 1e-8 * omega);
    EXPECT_NEAR(of(Integrator::kRungeKutta4).angle() / dt, runge_kutta, 1e-8 * omega);
    EXPECT_NEAR(of(Integrator::kRungeKutta4).largest_factor(), factor, 1e-9);
    EXPECT_NEAR(of(Integrator::kExplicitEuler).largest_factor(), std::hypot(1.0, omega * dt), 1e-9);
  }
}

// Trace and determinant of [[1 - z^2, h (1 - 2 zeta z)], [-h omega^2, 1 - 2 zeta z]].
TEST(OscillatorRecurrence, HasTraceAndDeterminantOfTheAmplificationMatrix) {
  for (double zeta : {0.0, 0.2, 1.0}) {
    const double z = 0.3;
    const OscillatorRecurrence found =
        measured_recurrence(scheme_of(Integrator::kSymplecticEuler), zeta, z);
    EXPECT_NEAR(found.trace, 2.0 - z * z - 2.0 * zeta * z, 1e-8) << zeta;
    EXPECT_NEAR(found.determinant, 1.0 - 2.0 * zeta * z, 1e-8) << zeta;
  }
}

TEST(OscillatorRecurrence, OfWhatExplodesIsInfinite) {
  const OscillatorRecurrence found =
      measured_recurrence(scheme_of(Integrator::kSymplecticEuler), 0.0, 1000.0);
  EXPECT_TRUE(std::isinf(found.largest_factor()));
}

// All integrators that have a limit, against their closed forms.
TEST(MeasuredStepLimit, IsTheAnalyticOne) {
  for (const Scheme& scheme : schemes()) {
    for (double zeta : {0.05, 0.2, 1.0, 5.0}) {
      const double analytic = scheme.step_limit(1.0, zeta);
      if (!std::isfinite(analytic)) continue;
      const double error = scheme.precision == SpringPrecision::kDouble ? 1e-5 : 2e-3;
      EXPECT_NEAR(measured_step_limit(scheme, zeta, analytic / 8.0, 8.0 * analytic) / analytic, 1.0,
                  error)
          << scheme.name << ' ' << zeta;
    }
  }
}

}  // namespace
}  // namespace limber
