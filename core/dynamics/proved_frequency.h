#pragma once

#include <cstddef>
#include <optional>

#include "core/analysis/tangent_stiffness.h"

namespace limber {

// Upper bound on the square root of the largest eigenvalue of M^-1/2 K M^-1/2, rad/s, 0.5 % above
// it as a rule: Lanczos's method finds an estimate omega, a sparse Cholesky factorisation of (1.005
// omega)^2 - M^-1/2 K M^-1/2 proves that nothing lies above it (it is positive definite exactly
// then). Where it does not, 3 % are added and so on: about once in a thousand lattices the estimate
// is of another mode. None where the factor would have more than `most_entries`, or no proof
// succeeds.
std::optional<double> proved_frequency(const SparseMatrix& scaled_stiffness,
                                       std::size_t most_entries);

}  // namespace limber
