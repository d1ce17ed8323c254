// Springs against closed forms and against another integrator.

#include <gtest/gtest.h>

#include <cmath>

#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kStiffness = 300.0;

// Masses 1 and 2 kg: m_red = 2/3 kg, omega = sqrt(300 / (2/3)) = 21.2 rad/s.
const double kOmega = std::sqrt(450.0);

Lattice two_masses(double stretch, double relative_speed, double damping) {
  PhysicalModel model = test::chain({.points = 2, .stiffness = kStiffness});
  model.points[PointId(1)].mass = 2.0;
  model.geometry.points[PointId(1)].x() += stretch;
  model.points[PointId(0)].velocity.x() = -relative_speed * 2.0 / 3.0;
  model.points[PointId(1)].velocity.x() = relative_speed / 3.0;
  model.edges[EdgeId(0)].damping = damping;
  return test::lattice_of({model});
}

double stretch_of(const Lattice& lattice) {
  return (lattice.motion[1].position - lattice.motion[0].position).norm() - 1.0;
}

// s_n = v dt sin(n theta) / sin(theta), theta = 2 asin(omega dt / 2): the recurrence of the
// integrator solved exactly, over 50 periods.
TEST(Oscillator, FollowsTheExactSolutionOfSemiImplicitEuler) {
  constexpr double kStep = 2e-3, kSpeed = 1.5;
  Lattice lattice = two_masses(0.0, kSpeed, 0.0);
  TimeOperator time(lattice);
  const double theta = 2.0 * std::asin(0.5 * kOmega * kStep);
  for (int n = 1; n <= 7400; ++n) {
    time.advance(1, kStep, kEmptySpace);
    const double wanted = kSpeed * kStep * std::sin(n * theta) / std::sin(theta);
    ASSERT_NEAR(stretch_of(lattice), wanted, 1e-10) << "step " << n;
  }
}

// Amplitude v / omega, zeros at multiples of pi / omega. The integrator's own amplitude is larger
// by (omega dt)^2 / 8 = 1.2e-6, its frequency by (omega dt)^2 / 24, 2.6e-4 rad in 100 periods.
TEST(Oscillator, HasTheFrequencyAndAmplitudeOfTheClosedForm) {
  constexpr double kSpeed = 1.5;
  const int steps = 2000;  // a period
  const double dt = 2.0 * M_PI / kOmega / steps;
  Lattice lattice = two_masses(0.0, kSpeed, 0.0);
  TimeOperator time(lattice);
  time.advance(steps / 4, dt, kEmptySpace);
  EXPECT_NEAR(stretch_of(lattice), kSpeed / kOmega, 2e-6 * kSpeed / kOmega);
  time.advance(100 * steps - steps / 4, dt, kEmptySpace);
  EXPECT_NEAR(stretch_of(lattice), 0.0, 3e-4 * kSpeed / kOmega);
  EXPECT_NEAR(lattice.motion[1].velocity.x(), kSpeed / 3.0, 1e-6);
}

// zeta = c / (2 m_red omega); s = v / omega_d exp(-zeta omega t) sin(omega_d t).
TEST(Oscillator, DecaysWithItsDampingRatio) {
  constexpr double kSpeed = 1.5, kZeta = 0.1;
  const double damping = 2.0 * kZeta * (2.0 / 3.0) * kOmega;
  const double damped_omega = kOmega * std::sqrt(1.0 - kZeta * kZeta);
  const double dt = 2.0 * M_PI / damped_omega / 20000;
  Lattice lattice = two_masses(0.0, kSpeed, damping);
  TimeOperator time(lattice);
  time.advance(5000, dt, kEmptySpace);
  for (int period = 0; period < 5; ++period) {
    const double t = (5000 + 20000 * period) * dt;
    const double wanted = kSpeed / damped_omega * std::exp(-kZeta * kOmega * t);
    EXPECT_NEAR(stretch_of(lattice), wanted, 1e-3 * wanted) << "period " << period;
    time.advance(20000, dt, kEmptySpace);
  }
}

// ---------------------------------------------------------------------------------------------

using State = std::vector<PointMotion>;

// dx/dt = v, dv/dt = F / m, with the springs written out from their definition.
State rates(const Lattice& lattice, const State& state) {
  State rate(state.size(), {Vec3::Zero(), Vec3::Zero()});
  for (std::size_t p = 0; p < state.size(); ++p) rate[p].position = state[p].velocity;
  for (const Spring& s : lattice.springs) {
    const Vec3 d = state[s.b].position - state[s.a].position;
    const Vec3 w = state[s.b].velocity - state[s.a].velocity;
    const Vec3 n = d / d.norm();
    const Vec3 force = (s.stiffness * (d.norm() - s.rest_length) + s.damping * w.dot(n)) * n;
    rate[s.a].velocity += force / lattice.mass[s.a];
    rate[s.b].velocity -= force / lattice.mass[s.b];
  }
  return rate;
}

State plus(State state, const State& rate, double dt) {
  for (std::size_t p = 0; p < state.size(); ++p) {
    state[p].position += dt * rate[p].position;
    state[p].velocity += dt * rate[p].velocity;
  }
  return state;
}

State by_runge_kutta(const Lattice& lattice, double seconds, int steps) {
  const double dt = seconds / steps;
  State state = lattice.motion;
  for (int n = 0; n < steps; ++n) {
    const State k1 = rates(lattice, state), k2 = rates(lattice, plus(state, k1, 0.5 * dt));
    const State k3 = rates(lattice, plus(state, k2, 0.5 * dt));
    const State k4 = rates(lattice, plus(state, k3, dt));
    state = plus(plus(state, k1, dt / 6.0), k2, dt / 3.0);
    state = plus(plus(state, k3, dt / 3.0), k4, dt / 6.0);
  }
  return state;
}

double largest_error(const State& found, const State& wanted) {
  double error = 0.0;
  for (std::size_t p = 0; p < found.size(); ++p) {
    error = std::max(error, (found[p].position - wanted[p].position).norm());
  }
  return error;
}

// A damped block with uneven masses in large, non-linear vibration.
TEST(Oscillator, OfALatticeConvergesToRungeKuttaWithFirstOrder) {
  PhysicalModel model = test::block({.cells = {2, 1, 1}});
  int i = 0;
  for (PointAttributes& p : model.points) p.mass = 0.5 + (i++ * 7 % 11) / 5.0;
  for (EdgeAttributes& e : model.edges) e.break_threshold = kUnbreakable;
  Lattice start = test::lattice_of({model});
  test::shake(start, 51, 1.0);
  constexpr double kSeconds = 0.5;
  const State wanted = by_runge_kutta(start, kSeconds, 2000);
  double last = 0.0;
  for (int steps : {1000, 2000, 4000, 8000}) {
    Lattice lattice = start;
    TimeOperator(lattice).advance(steps, kSeconds / steps, kEmptySpace);
    const double error = largest_error(lattice.motion, wanted);
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 2.0, 0.1) << steps << " steps";
    }
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

}  // namespace
}  // namespace limber
