#pragma once

#include <Eigen/Geometry>

#include "bullet_bridge/precision.h"
#include "core/dynamics/rigid_motion.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// Mass properties in the frame of the principal axes, from the deformed points of a piece.
struct ProxyFrame {
  double mass = 0.0;               // kg
  Vec3 centre;                     // m, world
  Eigen::Quaterniond orientation;  // principal axes to world
  Vec3 moments;                    // kg m^2, about the principal axes, all > 0
  Vec3 velocity;                   // P / M
  Vec3 angular_velocity;           // I^-1 L
  bool regularised = false;        // a moment was raised
};

// A piece whose points lie on a line has no moment about it (and no angular momentum there either,
// so that L stays exact): Bullet gets this share of the largest moment instead of zero.
inline constexpr double kSmallestMomentShare = 1e-4;

// `axes`: to be taken where they are principal ones to rounding. A cube has no others to tell from
// them, and stands in its own only by these.
ProxyFrame proxy_frame(const RigidMotion& motion, const Mat3& axes = Mat3::Identity());

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
