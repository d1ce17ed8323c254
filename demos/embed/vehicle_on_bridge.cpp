// Bullet's raycast vehicle drives over a bridge that bends under it. What Limber adds is marked.

#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>

#include "bullet_bridge/co_simulation.h"  // Limber
#include "core/modeller/box_lattice.h"    // Limber
#include "core/modeller/material.h"       // Limber

int main() {
  using Info = btRigidBody::btRigidBodyConstructionInfo;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btBoxShape bank_shape(btVector3(4, 1, 10)), car_shape(btVector3(btScalar(0.8), btScalar(0.3), 1));
  btRigidBody near_bank(Info(0, nullptr, &bank_shape)), far_bank(Info(0, nullptr, &bank_shape));
  near_bank.translate(btVector3(0, -1, -13));
  far_bank.translate(btVector3(0, -1, 13));  // six metres are between them
  btRigidBody chassis(Info(400, nullptr, &car_shape, btVector3(150, 220, 95)));
  chassis.translate(btVector3(0, 1, -6));
  chassis.setActivationState(DISABLE_DEACTIVATION);
  for (btRigidBody* body : {&near_bank, &far_bank, &chassis}) world.addRigidBody(body);

  btDefaultVehicleRaycaster raycaster(&world);
  btRaycastVehicle car({}, &chassis, &raycaster);
  world.addVehicle(&car);
  car.setCoordinateSystem(0, 1, 2);
  for (int i = 0; i < 4; ++i) {
    const btVector3 place(btScalar(1.4 * (i % 2) - 0.7), 0, btScalar(1.6 * (i / 2) - 0.8));
    car.addWheel(place, {0, -1, 0}, {-1, 0, 0}, btScalar(0.4), btScalar(0.3), {}, i < 2);
    car.applyEngineForce(200, i);
  }

  limber::bullet::CoSimulation limber(world);  // Limber
  const limber::Material deck{.density = 500, .youngs_modulus = 5e7, .damping_ratio = 0.3};
  limber::PhysicalModel bridge = limber::with_material(  // Limber: 2 m wide, 6 m long
      limber::box_lattice({8, 1, 24}, {0.25, 0.25, 0.25}, {-1, -0.25, -3}, "deck"), "bridge", deck);
  for (limber::PointId p : limber::ids_of(bridge.points))  // Limber: its ends are held
    bridge.points[p].pinned = std::abs(bridge.geometry.points[p].z()) > 2.9;
  limber.add(bridge);

  double lowest = 0;
  for (int tick = 0; tick < 600 && chassis.getCenterOfMassPosition().z() < 6; ++tick) {
    world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
    for (int i = 0; i < 4; ++i) {  // Limber: Bullet's vehicles push the ground with nothing
      const btWheelInfo& wheel = car.getWheelInfo(i);
      const btVector3& at = wheel.m_raycastInfo.m_contactPointWS;
      const limber::Vec3 push(0, -wheel.m_wheelsSuspensionForce / 60, 0);  // N s
      if (std::abs(at.z()) < 3) limber.apply_impulse(0, push, {at.x(), at.y(), at.z()});
    }
    lowest = std::fmin(lowest, limber.model(0).geometry.points[limber::PointId(229)].y());
  }
  if (limber.failure()) std::fprintf(stderr, "%s\n", limber.failure()->text().c_str());
  std::printf("at %.1f m: the bridge gave way by %.0f mm\n", chassis.getCenterOfMassPosition().z(),
              -1000 * lowest);
}
