#include "core/analysis/vibration.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/analysis/extreme_eigenvalues.h"
#include "core/analysis/tangent_stiffness.h"

namespace limber {
namespace {

double frequency(double omega_squared) { return std::sqrt(std::max(0.0, omega_squared)); }

}  // namespace

VibrationModes vibration_modes(const PhysicalModel& model) {
  const FreePoints free = unpinned_points(model);
  if (free.points.empty()) return {};
  const Eigen::MatrixXd stiffness = scaled_stiffness(model);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      stiffness);  // reads the lower triangle
  return {free.points, solver.eigenvalues(),
          mass_scale(model, free).asDiagonal() * solver.eigenvectors()};
}

int zero_mode_count(const VibrationModes& modes) {
  constexpr double kRounding = 1e-11;
  if (modes.omega_squared.size() == 0) return 0;
  const auto magnitude = modes.omega_squared.array().abs();
  return static_cast<int>((magnitude <= kRounding * magnitude.maxCoeff()).count());
}

std::vector<double> lowest_frequencies(const PhysicalModel& model, int count) {
  const Eigen::VectorXd squares = smallest_eigenpairs(scaled_stiffness(model), count).values;
  std::vector<double> omega(squares.size());
  std::transform(squares.begin(), squares.end(), omega.begin(), frequency);
  return omega;
}

double exact_highest_frequency(const PhysicalModel& model) {
  return frequency(largest_eigenvalue(scaled_stiffness(model)));
}

}  // namespace limber
