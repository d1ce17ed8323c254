#pragma once

#include <Eigen/Geometry>

#include "core/model/vec3.h"

namespace limber {

// Orientation (body to world) after turning for dt (s) at a constant angular velocity (rad/s, world
// frame): the exponential map.
Eigen::Quaterniond turned(const Eigen::Quaterniond& orientation, const Vec3& omega, double dt);

// Rotation of a free rigid body over dt (s), with its angular momentum kept to rounding.
// `orientation`: principal axes to world; `omega`: rad/s, world frame; both are updated. `moments`:
// about the principal axes, kg m^2, > 0.
//
// q' = omega q / 2 with omega = R I^-1 R^T L, by the commutator-free Lie group method of fourth
// order CF4 (Celledoni, Marthinsen and Owren, Future Generation Computer Systems 19 (2003) 341), in
// steps that turn by at most a twentieth of a radian.
void rotate_freely(Eigen::Quaterniond& orientation, Vec3& omega, const Vec3& moments, double dt);

}  // namespace limber
