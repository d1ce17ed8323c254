// A world from a .bullet file (such as save_world's), and a beam that breaks in it. What Limber
// adds is marked.

#include <BulletWorldImporter/btBulletWorldImporter.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>

#include "bullet_bridge/co_simulation.h"   // Limber
#include "core/modeller/box_lattice.h"     // Limber
#include "core/modeller/material_table.h"  // Limber

int main(int argc, char** argv) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btBulletWorldImporter importer(&world);
  if (argc != 2 || !importer.loadFile(argv[1])) {
    std::fprintf(stderr, "usage: load_world FILE.bullet (that save_world has written)\n");
    return 2;
  }
  std::printf("%d bodies from the file\n", world.getNumCollisionObjects());

  {
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
  }  // Limber leaves the world as it was before the importer frees it
  importer.deleteAllData();
}
