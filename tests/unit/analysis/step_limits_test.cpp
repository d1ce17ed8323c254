#include "core/analysis/step_limits.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/dynamics/stable_step.h"
#include "core/modeller/cubic_lattice.h"

namespace limber {
namespace {

using Matrix = Eigen::Matrix2d;

// x' = v, v' = -omega^2 x - 2 zeta omega v.
Matrix system(double omega, double zeta) {
  Matrix a;
  a << 0.0, 1.0, -omega * omega, -2.0 * zeta * omega;
  return a;
}

// What one step multiplies (x, v) by.
Matrix explicit_euler(double omega, double zeta, double dt) {
  return Matrix::Identity() + dt * system(omega, zeta);
}

Matrix symplectic_euler(double omega, double zeta, double dt) {
  Matrix kick = Matrix::Identity(), drift = Matrix::Identity();
  kick.row(1) += dt * system(omega, zeta).row(1);
  drift(0, 1) = dt;
  return drift * kick;
}

Matrix runge_kutta4(double omega, double zeta, double dt) {
  const Matrix z = dt * system(omega, zeta);
  return Matrix::Identity() + z + z * z / 2.0 + z * z * z / 6.0 + z * z * z * z / 24.0;
}

double spectral_radius(const Matrix& amplification) {
  return amplification.eigenvalues().cwiseAbs().maxCoeff();
}

// Just inside the limit the spectral radius is at most 1, just outside more.
void expect_limit(Matrix (*amplification)(double, double, double), double omega, double zeta,
                  double limit) {
  SCOPED_TRACE(zeta);
  EXPECT_LE(spectral_radius(amplification(omega, zeta, limit * (1.0 - 1e-6))), 1.0 + 1e-12);
  EXPECT_GT(spectral_radius(amplification(omega, zeta, limit * (1.0 + 1e-6))), 1.0 + 1e-12);
  for (double share : {0.01, 0.1, 0.3, 0.5, 0.7, 0.9}) {
    EXPECT_LE(spectral_radius(amplification(omega, zeta, share * limit)), 1.0 + 1e-12) << share;
  }
}

TEST(StepLimits, AreWhereTheSpectralRadiusPassesOne) {
  const double omega = 250.0;
  for (double zeta : {0.003, 0.1, 0.3, 0.45, 0.7, 0.99, 1.0, 1.01, 2.0, 30.0, 100.0}) {
    expect_limit(symplectic_euler, omega, zeta, stable_step(omega, zeta));
    expect_limit(explicit_euler, omega, zeta, explicit_euler_step_limit(omega, zeta));
    expect_limit(runge_kutta4, omega, zeta, runge_kutta4_step_limit(omega, zeta));
  }
}

TEST(StepLimits, WithoutDampingAreTheClosedForms) {
  EXPECT_EQ(explicit_euler_step_limit(250.0, 0.0), 0.0);
  EXPECT_NEAR(runge_kutta4_step_limit(250.0, 0.0), 2.0 * std::sqrt(2.0) / 250.0, 1e-15);
  // The end of the stability region on the real axis: the root of z^3/24 + z^2/6 + z/2 + 1 = 0.
  EXPECT_NEAR(runge_kutta4_step_limit(1.0, 1.0), 2.785293563405282, 1e-12);
}

TEST(StepLimits, KeepTheirDigitsWhereDampingIsAll) {
  EXPECT_DOUBLE_EQ(explicit_euler_step_limit(1.0, 1e200), 1e-200);
  EXPECT_DOUBLE_EQ(runge_kutta4_step_limit(1.0, 1e200), 2.785293563405282 / 2e200);
}

// Damping proportional to stiffness: of all modes the highest has the smallest limit.
TEST(StepLimits, OfTheHighestModeHoldForAll) {
  for (auto limit : {stable_step, explicit_euler_step_limit, runge_kutta4_step_limit}) {
    for (double beta : {0.001, 0.1, 0.5, 1.0, 2.0, 30.0}) {
      const double least = limit(1.0, 0.5 * beta);
      for (double omega = 0.01; omega < 1.0; omega += 0.01) {
        EXPECT_LE(least, limit(omega, 0.5 * beta * omega) * (1.0 + 1e-12)) << beta << ' ' << omega;
      }
    }
  }
}

// A free chain's longitudinal vibrations, in all three directions.
TEST(LargeStrainFrequency, OfAChainIsTheClosedForm) {
  const PhysicalModel chain =
      cubic_lattice({.points = {7, 1, 1}, .springs = {300.0, 0.0, 0.0}, .mass = 0.5});
  const double pi = std::acos(-1.0);
  EXPECT_NEAR(large_strain_frequency(chain), 2.0 * std::sqrt(300.0 / 0.5) * std::cos(pi / 14.0),
              1e-7);
}

// Of the stretched lattice as it is, dense.
TEST(LargeStrainFrequency, IsApproachedByAStretchedLattice) {
  PhysicalModel block = cubic_lattice({.points = {3, 3, 3}, .springs = {1.0, 1.0, 1.0}});
  const double bound = large_strain_frequency(block);
  for (Vec3& x : block.geometry.points) x *= 1e6;
  const FrequencyBound stretched = highest_frequency(block);
  EXPECT_LE(stretched.omega_max, 1.006 * bound);
  EXPECT_GE(stretched.omega_max, 0.999 * bound);
}

}  // namespace
}  // namespace limber
