#include "core/analysis/oscillator_recurrence.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "core/model/errors.h"
#include "core/modeller/cubic_lattice.h"

namespace limber {
namespace {

using Complex = std::complex<double>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kSamples = 64;
constexpr std::size_t kLeastSamples = 4;

// Elongations in rest lengths. The start is far from turning the spring inside out and far above
// the quanta of single precision; samples end before a step, and what a Runge-Kutta method tries
// within it, can turn the spring.
struct Range {
  double start, most;
};

Range range_of(SpringPrecision precision) {
  return precision == SpringPrecision::kDouble ? Range{1e-6, 0.05} : Range{1e-2, 0.5};
}

// Of the spectral radius; rounding, measured, is 1e-12 and below in double precision, a few 1e-5 in
// single.
double tolerance_of(SpringPrecision precision) {
  return precision == SpringPrecision::kDouble ? 1e-9 : 1e-3;
}

Complex larger_root(const OscillatorRecurrence& r) {
  const Complex root = std::sqrt(Complex(r.trace * r.trace - 4.0 * r.determinant));
  const Complex plus = 0.5 * (r.trace + root), minus = 0.5 * (r.trace - root);
  return std::abs(plus) >= std::abs(minus) ? plus : minus;
}

// 1 m, 1 kg at each end, omega = sqrt(2) rad/s.
Lattice oscillator(double damping_ratio, double start) {
  PhysicalModel model = cubic_lattice({.points = {2, 1, 1},
                                       .spacing = 1.0,
                                       .origin = Vec3(-0.5, 0.0, 0.0),
                                       .springs = {1.0, 0.0, 0.0},
                                       .damping_per_stiffness = std::sqrt(2.0) * damping_ratio});
  model.geometry.points[PointId(std::size_t{1})].x() += start;
  Lattice lattice;
  add_object(lattice, std::move(model));
  rebuild_active(lattice);
  return lattice;
}

double elongation(const Lattice& lattice) {
  return lattice.motion[1].position.x() - lattice.motion[0].position.x() - 1.0;
}

std::vector<double> elongations(const Scheme& scheme, double damping_ratio, double omega_step) {
  const auto [start, most] = range_of(scheme.precision);
  Lattice lattice = oscillator(damping_ratio, start);
  TimeOperator time(lattice, scheme.integrator, scheme.precision);
  std::vector<double> samples;
  while (samples.size() < kSamples && std::abs(elongation(lattice)) < most) {
    samples.push_back(elongation(lattice));
    time.advance(1, omega_step / std::sqrt(2.0), kEmptySpace);
  }
  return samples;
}

}  // namespace

double OscillatorRecurrence::largest_factor() const {
  return determinant == kInfinity ? kInfinity : std::abs(larger_root(*this));
}

double OscillatorRecurrence::angle() const { return std::abs(std::arg(larger_root(*this))); }

OscillatorRecurrence measured_recurrence(const Scheme& scheme, double damping_ratio,
                                         double omega_step) {
  const std::vector<double> u = elongations(scheme, damping_ratio, omega_step);
  if (u.size() < kLeastSamples) return {0.0, kInfinity};
  const auto rows = static_cast<Eigen::Index>(u.size()) - 2;
  const Eigen::Map<const Eigen::VectorXd> all(u.data(), rows + 2);
  Eigen::MatrixXd before(rows, 2);
  before << all.segment(1, rows), -all.head(rows);
  const Eigen::Vector2d fit = before.colPivHouseholderQr().solve(all.tail(rows));
  return {fit[0], fit[1]};
}

double measured_step_limit(const Scheme& scheme, double damping_ratio, double from, double to) {
  constexpr int kHalvings = 24;
  const auto stable = [&](double omega_step) {
    return measured_recurrence(scheme, damping_ratio, omega_step).largest_factor() <=
           1.0 + tolerance_of(scheme.precision);
  };
  if (!stable(from)) return 0.0;
  if (stable(to)) return kInfinity;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(from * to);
    (stable(middle) ? from : to) = middle;
  }
  return from;
}

}  // namespace limber
