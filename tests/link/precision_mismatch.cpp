#include <btBulletDynamicsCommon.h>

#include "bullet_bridge/co_simulation.h"

// A game built for float64 and linked with the float32 bridge. This must not link, and the linker
// must name the precision (bullet_bridge/precision.h).
int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, nullptr, &configuration);
  const limber::bullet::CoSimulation simulation(world);
  return static_cast<int>(simulation.object_count());
}
