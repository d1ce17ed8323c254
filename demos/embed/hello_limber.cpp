// Bullet's hello world with a beam that breaks over a kerb. What Limber adds is marked; README.md
// shows what stands between "readme begin" and "readme end" (tests/end_to_end/readme_test.sh).

#include <btBulletDynamicsCommon.h>

#include <cstdio>

#include "bullet_bridge/co_simulation.h"   // Limber
#include "core/modeller/box_lattice.h"     // Limber
#include "core/modeller/material_table.h"  // Limber

int main() {
  btStaticPlaneShape floor_shape(btVector3(0, 1, 0), 0);
  btRigidBody floor(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &floor_shape));
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

  limber::bullet::CoSimulation limber(world);  // Limber: takes part in every step from now on
  limber::Material brick = limber::material_named("brick").material;  // Limber
  brick.softening = 1000;            // Limber: modulus / 1000; the same impact speed breaks it
  limber.add(limber::with_material(  // Limber: 60 x 10 x 10 cm, 1 m above the floor
      limber::box_lattice({12, 2, 2}, {0.05, 0.05, 0.05}, {-0.3, 1, 0}, ""), "beam", brick));

  for (int tick = 0; tick < 180; ++tick) {
    world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
    if (limber.failure()) {  // Limber: its text says where, what and what to change
      std::fprintf(stderr, "%s\n", limber.failure()->text().c_str());
      return 1;
    }
  }

  for (const limber::bullet::PieceView& piece : limber.pieces()) {
    std::printf("%s piece of %g kg\n", piece.flexible ? "flexible" : "rigid", piece.motion.mass);
  }
  std::printf("%zu edges broke\n", limber.counters().broken_edges);
}
