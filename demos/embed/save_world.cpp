// Bullet's hello world, saved to a file for load_world.cpp. No Limber in it.

#include <btBulletDynamicsCommon.h>

#include <cstdio>

int main(int argc, char** argv) {
  btBoxShape floor_shape(btVector3(5, 1, 5));
  btRigidBody floor(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &floor_shape));
  floor.translate(btVector3(0, -1, 0));
  btBoxShape kerb_shape(btVector3(btScalar(0.05), btScalar(0.1), btScalar(0.3)));
  btRigidBody kerb(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &kerb_shape));
  kerb.translate(btVector3(0, btScalar(0.1), 0));

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, -10, 0));
  world.addRigidBody(&floor);
  world.addRigidBody(&kerb);

  btDefaultSerializer serializer;
  world.serialize(&serializer);
  std::FILE* file = argc == 2 ? std::fopen(argv[1], "wb") : nullptr;
  const auto size = static_cast<std::size_t>(serializer.getCurrentBufferSize());
  const bool written = file && std::fwrite(serializer.getBufferPointer(), size, 1, file) == 1;
  if (!file || std::fclose(file) != 0 || !written) {
    std::fprintf(stderr, "usage: save_world FILE.bullet (that can be written)\n");
    return 2;
  }
}
