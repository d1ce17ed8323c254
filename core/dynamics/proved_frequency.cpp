#include "core/dynamics/proved_frequency.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/analysis/extreme_eigenvalues.h"

namespace limber {
namespace {

// The proof looks this much above the estimate: at the eigenvalue itself the matrix is singular.
constexpr double kProofMargin = 1.005;

// Of the estimate's eigenvalue; half of that in the frequency, well within the margin. Finer would
// cost seconds on a rope of thousands of points, and be lost in the margin.
constexpr double kEstimateError = 1e-4;

// Knows after its analysis how large the factor will be.
class SizedCholesky : public Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> {
 public:
  std::size_t entries() const { return static_cast<std::size_t>(m_matrix.nonZeros()); }
};

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

}  // namespace

std::optional<double> proved_frequency(const SparseMatrix& scaled_stiffness,
                                       std::size_t most_entries) {
  SizedCholesky cholesky;
  cholesky.analyzePattern(scaled_stiffness);
  if (cholesky.entries() > most_entries) return std::nullopt;
  const double estimate =
      std::sqrt(std::max(0.0, largest_eigenvalue(scaled_stiffness, kEstimateError)));
  if (estimate == 0.0) return 0.0;  // pins hold both ends of every spring
  return proved_above_spectrum(cholesky, scaled_stiffness, kProofMargin * estimate);
}

}  // namespace limber
