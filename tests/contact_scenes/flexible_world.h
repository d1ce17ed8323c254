#pragma once

#include <memory>
#include <string>

#include "tests/contact_scenes/scene.h"

namespace limber::bullet::test {

// A Bullet world with flexible bodies in it, whoever moves these.
class FlexibleWorld {
 public:
  virtual ~FlexibleWorld() = default;
  virtual void step(double tick_s) = 0;
  virtual SceneState state() const = 0;
  // Why it stopped; empty while it runs.
  virtual std::string failure() const { return {}; }
};

// Limber's lattices in a btDiscreteDynamicsWorld.
std::unique_ptr<FlexibleWorld> limber_world(const Scene& scene);

// btSoftBody in a btSoftRigidDynamicsWorld at its best: 4 steps a tick of 5 iterations, links as
// stiff as they go and in random order. Its links do not break, and what they store has no unit:
// the models of state() have springs without stiffness.
std::unique_ptr<FlexibleWorld> bullet_soft_world(const Scene& scene);

}  // namespace limber::bullet::test
