#pragma once

#include <LinearMath/btTransform.h>

#include <Eigen/Geometry>

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

inline btVector3 to_bullet(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

inline Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// Normalised in double: Bullet's float quaternions are unit only to 1e-7, and a rotation made from
// them would scale what it rotates.
inline Eigen::Quaterniond from_bullet(const btQuaternion& q) {
  return Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized();
}

inline btQuaternion to_bullet(const Eigen::Quaterniond& q) {
  return {static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()), static_cast<btScalar>(q.z()),
          static_cast<btScalar>(q.w())};
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
