#include "bullet_bridge/waking.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

void wake(btDiscreteDynamicsWorld& world, btRigidBody& body) {
  if (body.isActive()) return;
  const int island = body.getIslandTag();
  for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
    btRigidBody* other = btRigidBody::upcast(world.getCollisionObjectArray()[i]);
    if (!other || other->isActive() || other->getIslandTag() != island) continue;
    if (other->isStaticOrKinematicObject()) continue;
    other->activate(true);
    other->applyGravity();
  }
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
