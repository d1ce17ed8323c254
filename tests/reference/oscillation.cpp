#include "tests/reference/oscillation.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace limber::reference {
namespace {

constexpr double kLeastZeta = 1e-9;

struct Roots {
  std::complex<double> first, second;
};

Roots roots_of(const Recurrence& r) {
  const std::complex<double> root = std::sqrt(std::complex<double>(r.a * r.a + 4.0 * r.b));
  return {0.5 * (r.a + root), 0.5 * (r.a - root)};
}

}  // namespace

double Recurrence::largest_factor() const {
  const Roots roots = roots_of(*this);
  return std::max(std::abs(roots.first), std::abs(roots.second));
}

double Recurrence::angle() const { return std::abs(std::arg(roots_of(*this).first)); }

Recurrence fit_recurrence(std::span<const double> samples) {
  if (samples.size() < 4) throw std::runtime_error("too few samples for a recurrence");
  const auto rows = static_cast<Eigen::Index>(samples.size()) - 2;
  const Eigen::Map<const Eigen::VectorXd> s(samples.data(), rows + 2);
  Eigen::MatrixXd before(rows, 2);
  before << s.segment(1, rows), s.head(rows);
  const Eigen::Vector2d fit = before.colPivHouseholderQr().solve(s.tail(rows));
  return {fit[0], fit[1]};
}

Oscillation fit_oscillation(std::span<const double> samples, double interval) {
  const Roots roots = roots_of(fit_recurrence(samples));
  const std::complex<double> first = std::log(roots.first) / interval;
  const std::complex<double> second = std::log(roots.second) / interval;
  Oscillation found;
  found.omega0 = std::sqrt((first * second).real());
  found.zeta = -0.5 * (first + second).real() / found.omega0;
  if (std::abs(found.zeta) < kLeastZeta) found.zeta = 0.0;
  found.omega_d = std::abs(first.imag());
  return found;
}

}  // namespace limber::reference
