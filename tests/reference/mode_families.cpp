#include "tests/reference/mode_families.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/vibration.h"

namespace limber::reference {
namespace {

// Share of the mode's squared displacements that is along the direction.
double share_along(const Eigen::VectorXd& shape, const Vec3& direction) {
  double along = 0.0;
  for (Eigen::Index row = 0; row < shape.size(); row += 3) {
    const double u = shape.segment<3>(row).dot(direction);
    along += u * u;
  }
  return along / shape.squaredNorm();
}

// Displacements towards where the last point goes, as a share of how far it goes.
std::vector<double> relative_to_last(const Eigen::VectorXd& shape) {
  const Vec3 last = shape.tail<3>();
  std::vector<double> relative;
  for (Eigen::Index row = 0; row < shape.size(); row += 3) {
    relative.push_back(shape.segment<3>(row).dot(last) / last.squaredNorm());
  }
  return relative;
}

}  // namespace

ModeFamilies mode_families(const PhysicalModel& chain, const Vec3& direction) {
  const VibrationModes modes = vibration_modes(chain);
  ModeFamilies families;
  std::vector<double> across;
  // Modes without stiffness mix both families and are counted below.
  for (Eigen::Index i = zero_mode_count(modes); i < modes.omega_squared.size(); ++i) {
    const Eigen::VectorXd shape = modes.shapes.col(i);
    const bool is_along = share_along(shape, direction) > 0.5;
    const double omega = std::sqrt(std::max(0.0, modes.omega_squared[i]));
    (is_along ? families.along : across).push_back(omega);
    if (!is_along && across.size() == 1) families.lowest_shape_across = relative_to_last(shape);
  }
  const std::size_t n = modes.free_points.size();
  families.along.insert(families.along.begin(), n - families.along.size(), 0.0);
  across.insert(across.begin(), 2 * n - across.size(), 0.0);
  for (std::size_t i = 0; i < across.size(); i += 2) families.across.push_back(across[i]);
  return families;
}

}  // namespace limber::reference
