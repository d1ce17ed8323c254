#include "core/analysis/step_limits.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/analysis/extreme_eigenvalues.h"

namespace limber {
namespace {

using Complex = std::complex<double>;

// zeta + sqrt(zeta^2 - 1): of the two rates of an overdamped oscillator the faster, over omega.
double faster_rate(double zeta) { return zeta + std::sqrt(zeta - 1.0) * std::sqrt(zeta + 1.0); }

// The root of lambda^2 + 2 zeta lambda + 1 that is largest in magnitude, or one of the pair.
Complex fastest_root(double zeta) {
  if (zeta < 1.0) return {-zeta, std::sqrt(1.0 - zeta * zeta)};
  return {-faster_rate(zeta), 0.0};
}

Complex runge_kutta4_factor(Complex z) {
  return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)));
}

// Where the ray from 0 leaves the stability region of Runge-Kutta 4. In the left half-plane it does
// so once, between the radii 2 and 4.
double runge_kutta4_reach(Complex unit_direction) {
  double inside = 2.0, outside = 4.0;
  while (true) {
    const double middle = 0.5 * (inside + outside);
    if (middle == inside || middle == outside) return inside;
    const bool stable = std::abs(runge_kutta4_factor(middle * unit_direction)) <= 1.0;
    (stable ? inside : outside) = middle;
  }
}

}  // namespace

double explicit_euler_step_limit(double omega, double zeta) {
  return (zeta < 1.0 ? 2.0 * zeta : 2.0 / faster_rate(zeta)) / omega;
}

double runge_kutta4_step_limit(double omega, double zeta) {
  const Complex root = fastest_root(zeta);
  const double rate = std::abs(root);
  return runge_kutta4_reach(root / rate) / rate / omega;
}

double large_strain_frequency(const PhysicalModel& model) {
  const auto count = static_cast<Eigen::Index>(model.points.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    const auto [a, b] = model.geometry.edges[e];
    const double k = model.edges[e].stiffness;
    const double mass_a = model.points[a].mass, mass_b = model.points[b].mass;
    entries.emplace_back(a.value, a.value, k / mass_a);
    entries.emplace_back(b.value, b.value, k / mass_b);
    entries.emplace_back(std::max(a.value, b.value), std::min(a.value, b.value),
                         -k / std::sqrt(mass_a * mass_b));
  }
  SparseMatrix lower(count, count);
  lower.setFromTriplets(entries.begin(), entries.end());
  return std::sqrt(std::max(0.0, largest_eigenvalue(lower)));
}

}  // namespace limber
