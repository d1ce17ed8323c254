#include "core/modeller/plane_fit.h"

#include <array>
#include <cmath>

#include "core/modeller/nonnegative_least_squares.h"

namespace limber {
namespace {

// The five components of a fully symmetric tensor of rank four in a plane, 1111 to 2222, each
// weighted with the root of how often it occurs, so that their norm is that of the tensor.
using PlaneTensor = Eigen::Matrix<double, 5, 1>;

PlaneTensor fourth_power(double x, double y) {
  return {x * x * x * x, 2.0 * x * x * x * y, std::sqrt(6.0) * x * x * y * y, 2.0 * x * y * y * y,
          y * y * y * y};
}

// 9/8 at 1111 and 2222, 3/8 at 1122.
PlaneTensor isotropic() { return {1.125, 0.0, std::sqrt(6.0) * 0.375, 0.0, 1.125}; }

}  // namespace

Eigen::VectorXd isotropic_plane_fit(std::span<const Vec3> directions, const Vec3& normal) {
  const Vec3 e1 = normal.unitOrthogonal();
  const Vec3 e2 = normal.normalized().cross(e1);
  Eigen::MatrixXd columns(5, directions.size());
  for (std::size_t e = 0; e < directions.size(); ++e) {
    const Eigen::Vector2d n =
        Eigen::Vector2d(directions[e].dot(e1), directions[e].dot(e2)).normalized();
    columns.col(static_cast<Eigen::Index>(e)) = fourth_power(n.x(), n.y());
  }
  // Parallel edges may share as they like: a small price on the size of x lets them share evenly.
  // Iterating (each round pays for the distance to the one before) takes its error away again, a
  // factor of about 1e-6 a round.
  constexpr double kPrice = 1e-6;
  const Eigen::Index n = columns.cols();
  const Eigen::MatrixXd H =
      columns.transpose() * columns + kPrice * Eigen::MatrixXd::Identity(n, n);
  const Eigen::VectorXd wanted = columns.transpose() * isotropic();
  Eigen::VectorXd x = nonnegative_minimum(H, wanted);
  for (int round = 0; round < 2; ++round) x = nonnegative_minimum(H, wanted + kPrice * x);
  return x;
}

}  // namespace limber
