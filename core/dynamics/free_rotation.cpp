#include "core/dynamics/free_rotation.h"

#include <cmath>

namespace limber {
namespace {

constexpr double kLargestTurn = 0.05;  // rad a step; the error of a step goes with its fifth power
// Steps of one call: 50 rad. What turns faster, 5e4 rad/s at a substep of a millisecond, is a blur
// or a mistake; without a bound a call would take for ever.
constexpr double kMostSteps = 1000.0;

Vec3 world_omega(const Eigen::Quaterniond& q, const Vec3& momentum, const Vec3& moments) {
  return q * Vec3((q.conjugate() * momentum).cwiseQuotient(moments));
}

Eigen::Quaterniond fourth_order_step(const Eigen::Quaterniond& q, const Vec3& momentum,
                                     const Vec3& moments, double h) {
  const auto slope = [&](const Eigen::Quaterniond& at) {
    return world_omega(at, momentum, moments);
  };
  const Vec3 k1 = slope(q);
  const Eigen::Quaterniond half = turned(q, k1, 0.5 * h);
  const Vec3 k2 = slope(half);
  const Vec3 k3 = slope(turned(q, k2, 0.5 * h));
  const Vec3 k4 = slope(turned(half, k3 - 0.5 * k1, h));
  const Eigen::Quaterniond middle = turned(q, 3.0 * k1 + 2.0 * k2 + 2.0 * k3 - k4, h / 12.0);
  return turned(middle, -k1 + 2.0 * k2 + 2.0 * k3 + 3.0 * k4, h / 12.0);
}

}  // namespace

Eigen::Quaterniond turned(const Eigen::Quaterniond& orientation, const Vec3& omega, double dt) {
  const double rate = omega.norm();
  if (rate == 0.0) return orientation;
  return (Eigen::Quaterniond(Eigen::AngleAxisd(rate * dt, omega / rate)) * orientation)
      .normalized();
}

void rotate_freely(Eigen::Quaterniond& orientation, Vec3& omega, const Vec3& moments, double dt) {
  const Vec3 momentum = orientation * moments.cwiseProduct(orientation.conjugate() * omega);
  const double turns = omega.norm() * std::abs(dt) / kLargestTurn;
  const int steps = 1 + static_cast<int>(turns < kMostSteps ? turns : kMostSteps);
  for (int i = 0; i < steps; ++i) {
    orientation = fourth_order_step(orientation, momentum, moments, dt / steps);
  }
  omega = world_omega(orientation, momentum, moments);
}

}  // namespace limber
