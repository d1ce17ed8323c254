#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross()

namespace limber {

// A vector in world coordinates (Y up) unless a name says otherwise. Eigen::Vector3d is not one of
// the "fixed-size vectorisable" types, so it is safe in headers compiled with any -m flags.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace limber
