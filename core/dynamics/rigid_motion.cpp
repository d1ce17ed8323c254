#include "core/dynamics/rigid_motion.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

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

Mat3 best_rotation(std::span<const PointMotion> motion, std::span<const Vec3> reference,
                   std::span<const double> mass, std::span<const std::int32_t> of) {
  double total = 0.0;
  Vec3 centre = Vec3::Zero(), reference_centre = Vec3::Zero();
  for (std::int32_t p : of) {
    total += mass[p];
    centre += mass[p] * motion[p].position;
    reference_centre += mass[p] * reference[p];
  }
  centre /= total;
  reference_centre /= total;
  Mat3 moment = Mat3::Zero();
  for (std::int32_t p : of) {
    moment +=
        mass[p] * (motion[p].position - centre) * (reference[p] - reference_centre).transpose();
  }
  const Eigen::JacobiSVD<Mat3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 proper = Mat3::Identity();
  proper(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * proper * svd.matrixV().transpose();
}

}  // namespace limber
