#pragma once

#include <Eigen/Geometry>
#include <random>

#include "core/model/vec3.h"

namespace limber::bullet::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 in_cube(double half) {
    return {between(-half, half), between(-half, half), between(-half, half)};
  }
  Vec3 direction() {
    Vec3 v;
    do v = in_cube(1.0);
    while (v.norm() > 1.0 || v.norm() < 0.01);
    return v.normalized();
  }
  Mat3 rotation() {
    return Eigen::Quaterniond(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1))
        .normalized()
        .toRotationMatrix();
  }

 private:
  std::mt19937 engine_;
};

}  // namespace limber::bullet::test
