#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// A bridge with nothing in it, and how it comes and goes.

namespace limber::bullet::test {
namespace {

void add_tumbling_pile(World& world) {
  world.add_ground();
  for (int i = 0; i < 12; ++i) {
    btRigidBody& box = world.add_box({0.2, 0.1 + 0.02 * (i % 3), 0.15}, 1.0 + i % 4,
                                     {0.07 * (i % 5), 0.4 + 0.35 * i, 0.05 * (i % 3)});
    box.setAngularVelocity(btVector3(btScalar(0.3 * i), btScalar(1.0), btScalar(-0.2 * i)));
  }
}

using Bits = std::vector<std::array<btScalar, 18>>;

Bits bits_of(const World& world) {
  Bits bits;
  for (const auto& body : world.bodies()) {
    std::array<btScalar, 18> state;
    for (int k = 0; k < 3; ++k) {
      state[k] = body->getWorldTransform().getOrigin()[k];
      state[3 + k] = body->getLinearVelocity()[k];
      state[6 + k] = body->getAngularVelocity()[k];
      for (int l = 0; l < 3; ++l) state[9 + 3 * k + l] = body->getWorldTransform().getBasis()[k][l];
    }
    bits.push_back(state);
  }
  return bits;
}

TEST(IdleBridge, ChangesNoBitOfATumblingPile) {
  World plain, bridged;
  add_tumbling_pile(plain);
  add_tumbling_pile(bridged);
  const Bits start = bits_of(plain);
  CoSimulation simulation(*bridged);
  for (int tick = 0; tick < 200; ++tick) {
    plain.step(kTick);
    bridged.step(kTick);
    ASSERT_EQ(bits_of(plain), bits_of(bridged)) << "tick " << tick;
  }
  EXPECT_NE(bits_of(plain), start);
}

// A lattice far away is stepped, but the pile is none of its business. (Bullet's tree finds pairs
// in another order with one body more, whosever it is: this broadphase knows no such order.)
TEST(IdleBridge, OfAFarLatticeChangesNoBitOfATumblingPile) {
  World plain(kGravity, SolverOwner::kCaller, std::make_unique<btSimpleBroadphase>());
  World bridged(kGravity, SolverOwner::kCaller, std::make_unique<btSimpleBroadphase>());
  add_tumbling_pile(plain);
  add_tumbling_pile(bridged);
  CoSimulation simulation(*bridged, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block({.modulus = 1e6}, {50.0, 100.0, 0.0}));
  for (int tick = 0; tick < 100; ++tick) {
    plain.step(kTick);
    bridged.step(kTick);
    ASSERT_EQ(bits_of(plain), bits_of(bridged)) << "tick " << tick;
  }
}

TEST(DetachedBridge, GivesTheSolverBackAndLeavesNothing) {
  World world;
  world.add_ground();
  ASSERT_EQ(world->getConstraintSolver(), &world.own_solver());
  const int bodies = world->getNumCollisionObjects();
  {
    CoSimulation simulation(*world);
    simulation.add(make_block({.modulus = 1e6}, {0.0, 1.0, 0.0}));
    EXPECT_NE(world->getConstraintSolver(), &world.own_solver());
    EXPECT_GT(world->getNumCollisionObjects(), bodies);
    world.run(0.1, kTick);
  }
  EXPECT_EQ(world->getConstraintSolver(), &world.own_solver());
  EXPECT_EQ(world->getNumCollisionObjects(), bodies);
  world.run(0.1, kTick);  // an action left behind would be called after its end
}

TEST(DetachedBridge, LeavesAPlainWorldsBits) {
  World plain, visited;
  add_tumbling_pile(plain);
  add_tumbling_pile(visited);
  { CoSimulation simulation(*visited); }
  for (int tick = 0; tick < 50; ++tick) {
    plain.step(kTick);
    visited.step(kTick);
  }
  EXPECT_EQ(bits_of(plain), bits_of(visited));
}

// Bullet frees such a solver when another one is set.
TEST(WorldThatOwnsItsSolver, KeepsItThroughABridge) {
  World world(kGravity, SolverOwner::kWorld);
  world.add_ground();
  btConstraintSolver* const own = world->getConstraintSolver();
  {
    CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
    simulation.add(make_block({.modulus = 1e6}, {0.0, 0.2, 0.0}));
    world.run(0.1, kTick);
    EXPECT_FALSE(simulation.failure());
  }
  EXPECT_EQ(world->getConstraintSolver(), own);
  btRigidBody& box = world.add_box({0.1, 0.1, 0.1}, 1.0, {0.0, 0.1, 0.0});
  world.run(0.5, kTick);
  EXPECT_NEAR(box.getWorldTransform().getOrigin().y(), 0.1, 0.005);
}

}  // namespace
}  // namespace limber::bullet::test
