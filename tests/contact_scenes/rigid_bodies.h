#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "tests/contact_scenes/scene.h"

namespace limber::bullet::test {

// A scene's rigid bodies and gravity in a world, for as long as this lives.
class RigidBodies {
 public:
  RigidBodies(btDiscreteDynamicsWorld& world, const Scene& scene);
  ~RigidBodies();
  RigidBodies(const RigidBodies&) = delete;
  RigidBodies& operator=(const RigidBodies&) = delete;

  // Kinematic bodies go where they are to be at the end of the coming step, s.
  void move_to(double time);
  std::vector<const btRigidBody*> all() const;

 private:
  struct KinematicState : btMotionState {
    btTransform pose;
    void getWorldTransform(btTransform& out) const override { out = pose; }
    void setWorldTransform(const btTransform&) override {}
  };

  btDiscreteDynamicsWorld& world_;
  std::vector<RigidSpec> specs_;
  std::vector<std::unique_ptr<KinematicState>> motions_;  // per body; none: not kinematic
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace limber::bullet::test
