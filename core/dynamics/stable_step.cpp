#include "core/dynamics/stable_step.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/element_bound.h"

namespace limber {
namespace {

struct Spring {
  std::size_t a, b;
  Vec3 direction;    // unit
  double stiffness;  // N/m
};

std::vector<Spring> springs_of(const PhysicalModel& model) {
  std::vector<Spring> springs;
  for (EdgeId e : ids_of(model.geometry.edges)) {
    if (model.edges[e].broken || model.edges[e].stiffness == 0.0) continue;
    const auto [a, b] = model.geometry.edges[e];
    const Vec3 along = model.geometry.points[b] - model.geometry.points[a];
    springs.push_back({a.index(), b.index(), along.normalized(), model.edges[e].stiffness});
  }
  return springs;
}

// 1 / sqrt(m) of every point: K is scaled to M^-1/2 K M^-1/2, symmetric with the same eigenvalues.
Eigen::VectorXd mass_scale(const PhysicalModel& model) {
  Eigen::VectorXd scale(model.points.size());
  for (PointId p : ids_of(model.points)) scale[p.index()] = 1.0 / std::sqrt(model.points[p].mass);
  return scale;
}

Eigen::VectorXd scaled_stiffness_times(const std::vector<Spring>& springs,
                                       const Eigen::VectorXd& scale, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (const Spring& s : springs) {
    const Vec3 difference = scale[s.a] * x.segment<3>(3 * s.a) - scale[s.b] * x.segment<3>(3 * s.b);
    const Vec3 force = s.stiffness * s.direction.dot(difference) * s.direction;
    y.segment<3>(3 * s.a) += scale[s.a] * force;
    y.segment<3>(3 * s.b) -= scale[s.b] * force;
  }
  return y;
}

// A fixed vector without symmetry, so that no mode is orthogonal to it: fractions of multiples of
// the golden ratio.
Eigen::VectorXd starting_vector(std::size_t size) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  Eigen::VectorXd x(size);
  for (std::size_t i = 0; i < size; ++i) x[i] = std::fmod((i + 1.0) * kGoldenRatio, 1.0) - 0.5;
  return x.normalized();
}

// Largest eigenvalue from below: the Rayleigh quotient never exceeds it.
double power_iteration(const std::vector<Spring>& springs, const Eigen::VectorXd& scale) {
  constexpr int kMostIterations = 300;
  constexpr double kConverged = 1e-5;  // relative growth per iteration; the proof adds 2 %
  Eigen::VectorXd x = starting_vector(3 * scale.size());
  double eigenvalue = 0.0;
  for (int i = 0; i < kMostIterations; ++i) {
    const Eigen::VectorXd y = scaled_stiffness_times(springs, scale, x);
    const double quotient = x.dot(y);
    const bool converged = quotient - eigenvalue < kConverged * quotient;
    eigenvalue = std::max(eigenvalue, quotient);
    if (converged && i > 20) break;
    const double norm = y.norm();
    if (norm == 0.0) break;
    x = y / norm;
  }
  return eigenvalue;
}

using Sparse = Eigen::SparseMatrix<double>;

// Lower triangle of M^-1/2 K M^-1/2.
Sparse scaled_stiffness(const std::vector<Spring>& springs, const Eigen::VectorXd& scale) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(springs.size() * 21 + 3 * scale.size());
  for (Eigen::Index i = 0; i < 3 * scale.size(); ++i) entries.emplace_back(i, i, 0.0);
  const auto add_block = [&](std::size_t a, std::size_t b, const Mat3& block) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (3 * a + i >= 3 * b + j) entries.emplace_back(3 * a + i, 3 * b + j, block(i, j));
      }
    }
  };
  for (const Spring& s : springs) {
    const Mat3 k = s.stiffness * s.direction * s.direction.transpose();
    add_block(s.a, s.a, scale[s.a] * scale[s.a] * k);
    add_block(s.b, s.b, scale[s.b] * scale[s.b] * k);
    add_block(std::max(s.a, s.b), std::min(s.a, s.b), -scale[s.a] * scale[s.b] * k);
  }
  Sparse matrix(3 * scale.size(), 3 * scale.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Knows after its analysis how large the factor will be.
class SizedCholesky : public Eigen::SimplicialLLT<Sparse, Eigen::Lower> {
 public:
  std::size_t entries() const { return static_cast<std::size_t>(m_matrix.nonZeros()); }
};

// The smallest of omega, 1.03 omega, ... for which omega^2 - M^-1/2 K M^-1/2 has a Cholesky
// factorisation, which proves that no frequency lies above it. `bound` is known to be one that has.
double proved_above_spectrum(SizedCholesky& cholesky, const Sparse& stiffness, double omega,
                             double bound) {
  Sparse identity(stiffness.rows(), stiffness.cols());
  identity.setIdentity();
  for (; omega < bound; omega *= 1.03) {
    // Relative to omega^2, so that pivots are near one whatever the units.
    cholesky.factorize(identity - stiffness / (omega * omega));
    if (cholesky.info() == Eigen::Success) return omega;
  }
  return bound;
}

}  // namespace

FrequencyBound highest_frequency(const PhysicalModel& model, std::size_t most_entries) {
  const std::vector<Spring> springs = springs_of(model);
  if (springs.empty()) return {0.0, true};
  const double bound = element_frequency_bound(model);
  const Eigen::VectorXd scale = mass_scale(model);
  const Sparse stiffness = scaled_stiffness(springs, scale);
  SizedCholesky cholesky;
  cholesky.analyzePattern(stiffness);
  if (cholesky.entries() > most_entries) return {bound, false};
  const double estimate = std::sqrt(power_iteration(springs, scale));
  return {proved_above_spectrum(cholesky, stiffness, 1.02 * estimate, bound), true};
}

double stable_step(double omega_rad_s, double damping_ratio) {
  if (omega_rad_s == 0.0) return std::numeric_limits<double>::infinity();
  return 2.0 / omega_rad_s * (std::sqrt(1.0 + damping_ratio * damping_ratio) - damping_ratio);
}

}  // namespace limber
