#include "tests/support/dense.h"

namespace limber::test {

Eigen::MatrixXd dense_matrix(const PhysicalModel& model, double EdgeAttributes::*coefficient) {
  const Eigen::Index n = 3 * static_cast<Eigen::Index>(model.points.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    const auto [a, b] = model.geometry.edges[e];
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    const Vec3 d = (model.geometry.points[b] - model.geometry.points[a]).normalized();
    row.segment<3>(3 * a.index()) = -d;
    row.segment<3>(3 * b.index()) = d;
    sum += model.edges[e].*coefficient * row * row.transpose();
  }
  return sum;
}

Eigen::VectorXd dense_masses(const PhysicalModel& model) {
  Eigen::VectorXd masses(3 * static_cast<Eigen::Index>(model.points.size()));
  for (PointId p : ids_of(model.points))
    masses.segment<3>(3 * p.index()).setConstant(model.points[p].mass);
  return masses;
}

}  // namespace limber::test
