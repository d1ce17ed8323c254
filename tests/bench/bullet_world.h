#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

namespace limber::bench {

// A plain Bullet world as a game would set it up, with a floor at y = 0 if wanted.
class BulletWorld {
 public:
  BulletWorld() { world_.setGravity({0, btScalar(-9.81), 0}); }
  ~BulletWorld() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  btDiscreteDynamicsWorld& world() { return world_; }

  // A box with these half sides; mass 0 does not move.
  btRigidBody& add_box(double mass_kg, const btVector3& half_m, const btVector3& centre_m) {
    shapes_.push_back(std::make_unique<btBoxShape>(half_m));
    btVector3 inertia(0, 0, 0);
    const auto mass = static_cast<btScalar>(mass_kg);
    if (mass > 0) shapes_.back()->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), inertia);
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin(centre_m);
    return add(info);
  }

  // Its shape has to outlive this.
  btRigidBody& add(const btRigidBody::btRigidBodyConstructionInfo& info) {
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world_.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }

  // A plain body with the shape, place and mass of a movable other one.
  btRigidBody& add_twin(const btRigidBody& other) {
    btRigidBody::btRigidBodyConstructionInfo info(
        1 / other.getInvMass(), nullptr, const_cast<btCollisionShape*>(other.getCollisionShape()),
        btVector3(1, 1, 1) / other.getInvInertiaDiagLocal());
    info.m_startWorldTransform = other.getWorldTransform();
    info.m_friction = other.getFriction();
    info.m_restitution = other.getRestitution();
    info.m_linearSleepingThreshold = other.getLinearSleepingThreshold();
    info.m_angularSleepingThreshold = other.getAngularSleepingThreshold();
    return add(info);
  }

  void add_floor() { add_box(0.0, {100, 1, 100}, {0, -1, 0}); }

  void tick() { world_.stepSimulation(btScalar(1.0 / 60.0), 0, btScalar(1.0 / 60.0)); }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace limber::bench
