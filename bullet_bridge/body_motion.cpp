#include "bullet_bridge/body_motion.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <vector>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Bullet gives the velocities of all links at once, each in its own frame; the base comes first.
BodySpeeds motion_of_link(const btMultiBodyLinkCollider& link) {
  const btMultiBody& body = *link.m_multiBody;
  const auto count = static_cast<std::size_t>(body.getNumLinks()) + 1;
  std::vector<btVector3> omega(count), velocity(count);
  body.compTreeLinkVelocities(omega.data(), velocity.data());
  const auto own = static_cast<std::size_t>(link.m_link + 1);
  return {from_bullet(body.localDirToWorld(link.m_link, velocity[own])),
          from_bullet(body.localDirToWorld(link.m_link, omega[own]))};
}

}  // namespace

BodySpeeds motion_of(const btCollisionObject& object) {
  if (const btRigidBody* body = btRigidBody::upcast(&object)) {
    return {from_bullet(body->getLinearVelocity()), from_bullet(body->getAngularVelocity())};
  }
  const btMultiBodyLinkCollider* link = btMultiBodyLinkCollider::upcast(&object);
  return link ? motion_of_link(*link) : BodySpeeds{};
}

double reach_of(const btCollisionObject& object) {
  btVector3 centre;
  btScalar radius = 0;
  object.getCollisionShape()->getBoundingSphere(centre, radius);
  return radius + centre.length();
}

double largest_speed(const BodySpeeds& motion, const btCollisionObject& object) {
  const double speed = motion.velocity.norm();
  if (motion.angular_velocity.isZero(0.0)) return speed;
  return speed + motion.angular_velocity.norm() * reach_of(object);
}

bool is_movable(const btCollisionObject& object) {
  return btRigidBody::upcast(&object) != nullptr && !object.isStaticOrKinematicObject();
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
