#include "core/dynamics/rigid_motion.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace limber {

double RigidMotion::kinetic_energy() const {
  return 0.5 * mass * velocity.squaredNorm() + 0.5 * angular_velocity.dot(angular_momentum);
}

Vec3 RigidMotion::velocity_at(const Vec3& position) const {
  return velocity + angular_velocity.cross(position - centre);
}

Vec3 angular_velocity_of(const Mat3& inertia, const Vec3& angular_momentum, double least_share) {
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(inertia);
  const double smallest = least_share * principal.eigenvalues()[2];
  Vec3 omega = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const double moment = principal.eigenvalues()[axis];
    if (moment <= smallest) continue;
    const Vec3 direction = principal.eigenvectors().col(axis);
    omega += direction * (direction.dot(angular_momentum) / moment);
  }
  return omega;
}

RigidMotion rigid_motion(std::span<const PointMotion> motion, std::span<const double> mass,
                         std::span<const std::int32_t> of) {
  RigidMotion body;
  Vec3 momentum = Vec3::Zero();
  for (std::int32_t p : of) {
    body.mass += mass[p];
    body.centre += mass[p] * motion[p].position;
    momentum += mass[p] * motion[p].velocity;
  }
  if (body.mass <= 0.0) return body;
  body.centre /= body.mass;
  body.velocity = momentum / body.mass;
  for (std::int32_t p : of) {
    const Vec3 r = motion[p].position - body.centre;
    body.angular_momentum += mass[p] * r.cross(motion[p].velocity - body.velocity);
    body.inertia += mass[p] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  body.angular_velocity = angular_velocity_of(body.inertia, body.angular_momentum);
  return body;
}

double kinetic_energy(std::span<const PointMotion> motion, std::span<const double> mass,
                      std::span<const std::int32_t> of) {
  double energy = 0.0;
  for (std::int32_t p : of) energy += 0.5 * mass[p] * motion[p].velocity.squaredNorm();
  return energy;
}

namespace {

// Points and their reference, both about their centres of mass.
struct Match {
  double mass = 0.0;                     // kg
  Vec3 centre = Vec3::Zero();            // m
  Vec3 reference_centre = Vec3::Zero();  // m
  Mat3 moment = Mat3::Zero();            // sum m x r^T, kg m^2
};

Match match_of(std::span<const PointMotion> motion, std::span<const Vec3> reference,
               std::span<const double> mass, std::span<const std::int32_t> of) {
  Match match;
  for (std::int32_t p : of) {
    match.mass += mass[p];
    match.centre += mass[p] * motion[p].position;
    match.reference_centre += mass[p] * reference[p];
  }
  match.centre /= match.mass;
  match.reference_centre /= match.mass;
  for (std::int32_t p : of) {
    match.moment += mass[p] * (motion[p].position - match.centre) *
                    (reference[p] - match.reference_centre).transpose();
  }
  return match;
}

}  // namespace

RigidFit rigid_fit(std::span<const PointMotion> motion, std::span<const Vec3> reference,
                   std::span<const double> mass, std::span<const std::int32_t> of) {
  RigidFit fit;
  if (of.empty()) return fit;
  const Match match = match_of(motion, reference, mass, of);
  const Eigen::JacobiSVD<Mat3> svd(match.moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 proper = Vec3::Ones();
  proper[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  fit.rotation = svd.matrixU() * proper.asDiagonal() * svd.matrixV().transpose();
  fit.singular_values = svd.singularValues().cwiseProduct(proper);
  double sum = 0.0;
  for (std::int32_t p : of) {
    const Vec3 carried = fit.rotation * (reference[p] - match.reference_centre);
    sum += mass[p] * (motion[p].position - match.centre - carried).squaredNorm();
  }
  fit.residual = std::sqrt(sum / match.mass);
  return fit;
}

Mat3 best_rotation(std::span<const PointMotion> motion, std::span<const Vec3> reference,
                   std::span<const double> mass, std::span<const std::int32_t> of) {
  return rigid_fit(motion, reference, mass, of).rotation;
}

}  // namespace limber
