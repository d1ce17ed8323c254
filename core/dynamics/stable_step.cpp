#include "core/dynamics/stable_step.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/analysis/extreme_eigenvalues.h"
#include "core/analysis/tangent_stiffness.h"
#include "core/dynamics/element_bound.h"
#include "core/model/errors.h"

namespace limber {
namespace {

// The proof looks this much above the estimate: at the eigenvalue itself the matrix is singular.
constexpr double kProofMargin = 1.005;

// Of the estimate's eigenvalue; half of that in the frequency, well within the margin. Finer would
// cost seconds on a rope of thousands of points, and be lost in the margin.
constexpr double kEstimateError = 1e-4;

// 1/s^2: sums of a thousand of these are still finite.
constexpr double kLargestSquare = 1e300;

// Knows after its analysis how large the factor will be.
class SizedCholesky : public Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> {
 public:
  std::size_t entries() const { return static_cast<std::size_t>(m_matrix.nonZeros()); }
};

// Entries of the matrix's lower triangle: the factor has at least these, in whatever order. Known
// before the matrix, which takes a minute to assemble and analyse for a million points.
std::size_t least_factor_entries(const PhysicalModel& model) {
  const auto moves = [&](PointId p) { return !model.points[p].pinned; };
  std::size_t entries = 0;
  for (const PointAttributes& point : model.points) entries += point.pinned ? 0 : 6;
  for (std::size_t e = 0; e < model.edges.size(); ++e) {
    const auto [a, b] = model.geometry.edges[EdgeId(e)];
    if (!model.edges[EdgeId(e)].broken && moves(a) && moves(b)) entries += 9;
  }
  return entries;
}

// The smallest of omega, 1.03 omega, ... for which omega^2 - M^-1/2 K M^-1/2 has a Cholesky
// factorisation, which proves that no frequency lies above it. The third or fourth does, if the
// estimate is good; none after many.
std::optional<double> proved_above_spectrum(SizedCholesky& cholesky, const SparseMatrix& stiffness,
                                            double omega) {
  constexpr int kMostTries = 64;
  SparseMatrix identity(stiffness.rows(), stiffness.cols());
  identity.setIdentity();
  for (int i = 0; i < kMostTries; ++i, omega *= 1.03) {
    // Relative to omega^2, so that pivots are near one whatever the units.
    cholesky.factorize(identity - stiffness / (omega * omega));
    if (cholesky.info() == Eigen::Success) return omega;
  }
  return std::nullopt;
}

FrequencyBound bound_by_elements(const PhysicalModel& model) {
  return {element_frequency_bound(model), false};
}

// Each number is finite, but stiffness over mass need not be.
void require_finite_frequencies(const PhysicalModel& model) {
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    const double lighter = std::min(model.points[a].mass, model.points[b].mass);
    if (model.edges[e].stiffness / lighter < kLargestSquare) continue;
    throw InputError({model.name + ": edge " + std::to_string(e.index()),
                      "its stiffness over the mass of its lighter point is beyond all numbers",
                      "check the units of stiffness, N/m, and mass, kg"});
  }
}

bool has_springs(const PhysicalModel& model) {
  return std::any_of(model.edges.begin(), model.edges.end(), [](const EdgeAttributes& edge) {
    return !edge.broken && edge.stiffness > 0.0;
  });
}

}  // namespace

FrequencyBound highest_frequency(const PhysicalModel& model, std::size_t most_entries) {
  if (!has_springs(model)) return {0.0, true};
  require_finite_frequencies(model);
  if (least_factor_entries(model) > most_entries) return bound_by_elements(model);
  const SparseMatrix stiffness = scaled_stiffness_bound(model);
  SizedCholesky cholesky;
  cholesky.analyzePattern(stiffness);
  if (cholesky.entries() > most_entries) return bound_by_elements(model);
  const double estimate = std::sqrt(std::max(0.0, largest_eigenvalue(stiffness, kEstimateError)));
  if (estimate == 0.0) return {0.0, true};  // pins hold both ends of every spring
  const auto proved = proved_above_spectrum(cholesky, stiffness, kProofMargin * estimate);
  return proved ? FrequencyBound{*proved, true} : bound_by_elements(model);
}

double stable_step(double omega_rad_s, double damping_ratio) {
  if (omega_rad_s == 0.0) return std::numeric_limits<double>::infinity();
  // The closed form without its cancellation, which leaves nothing from a ratio of 1e8 on.
  return 2.0 / omega_rad_s / (std::hypot(1.0, damping_ratio) + damping_ratio);
}

}  // namespace limber
