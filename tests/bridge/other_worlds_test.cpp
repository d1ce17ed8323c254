#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "core/storage/state_hash.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Every kind of world that a game may have: Limber comes, goes, and with no object in it changes
// nothing; the game's callbacks and pointers stay.

namespace limber::bullet::test {
namespace {

void add(StateHash& hash, const btVector3& v) {
  for (int k = 0; k < 3; ++k) hash.add(v[k]);
}

void add(StateHash& hash, const btTransform& pose) {
  add(hash, pose.getOrigin());
  for (int k = 0; k < 3; ++k) add(hash, pose.getBasis()[k]);
}

// A busy scene in one kind of world: 20 boxes and balls fall into a heap, two of them on a hinge.
class BusyWorld {
 public:
  virtual ~BusyWorld() = default;  // the world goes first and lets its bodies go
  virtual btDiscreteDynamicsWorld& world() = 0;

  void step() { world().stepSimulation(btScalar(kTick), 1, btScalar(kTick)); }

  // Of every bit that moves.
  std::uint64_t hash() {
    StateHash hash;
    for (const auto& body : bodies_) {
      add(hash, body->getWorldTransform());
      add(hash, body->getLinearVelocity());
      add(hash, body->getAngularVelocity());
      hash.add(body->getActivationState());
    }
    add_others(hash);
    return hash.value();
  }

 protected:
  void fill() {
    world().setGravity(btVector3(0, btScalar(-kGravity), 0));
    add_body(ground_, 0, btVector3(0, -1, 0));
    for (int i = 0; i < 20; ++i) {
      const btVector3 at(btScalar(0.1 * (i % 3)), btScalar(0.5 + 0.45 * i),
                         btScalar(0.07 * (i % 4)));
      add_body(i % 3 == 0 ? static_cast<btCollisionShape&>(ball_) : box_, btScalar(1 + i % 4), at);
      bodies_.back()->setAngularVelocity(btVector3(btScalar(0.3 * i), 1, btScalar(-0.2 * i)));
    }
    hinge_ = std::make_unique<btHingeConstraint>(
        *bodies_[1], *bodies_[2], btVector3(0, btScalar(0.25), 0), btVector3(0, btScalar(-0.25), 0),
        btVector3(0, 0, 1), btVector3(0, 0, 1));
    world().addConstraint(hinge_.get());
  }
  virtual void add_others(StateHash&) {}

 private:
  void add_body(btCollisionShape& shape, btScalar mass, const btVector3& at) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
    info.m_startWorldTransform.setOrigin(at);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world().addRigidBody(bodies_.back().get());
  }

  btBoxShape ground_{btVector3(20, 1, 20)};
  btBoxShape box_{btVector3(btScalar(0.2), btScalar(0.15), btScalar(0.1))};
  btSphereShape ball_{btScalar(0.2)};
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::unique_ptr<btHingeConstraint> hinge_;
};

class DiscreteWorld : public BusyWorld {
 public:
  DiscreteWorld() { fill(); }
  btDiscreteDynamicsWorld& world() override { return world_; }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

// With a cloth that falls over the heap.
class SoftWorld : public BusyWorld {
 public:
  SoftWorld() {
    fill();
    world_.getWorldInfo().m_gravity = world_.getGravity();
    cloth_.reset(btSoftBodyHelpers::CreatePatch(world_.getWorldInfo(), btVector3(-1, 2, -1),
                                                btVector3(1, 2, -1), btVector3(-1, 2, 1),
                                                btVector3(1, 2, 1), 9, 9, 0, true));
    cloth_->setTotalMass(1);
    world_.addSoftBody(cloth_.get());
  }
  ~SoftWorld() override { world_.removeSoftBody(cloth_.get()); }
  btDiscreteDynamicsWorld& world() override { return world_; }

 private:
  void add_others(StateHash& hash) override {
    for (int i = 0; i < cloth_->m_nodes.size(); ++i) {
      add(hash, cloth_->m_nodes[i].m_x);
      add(hash, cloth_->m_nodes[i].m_v);
    }
  }

  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::unique_ptr<btSoftBody> cloth_;
};

// With a chain of five links that swings through the heap.
class MultiBodyWorld : public BusyWorld {
 public:
  MultiBodyWorld() {
    fill();
    constexpr int kLinks = 5;
    chain_ = std::make_unique<btMultiBody>(kLinks, 1, btVector3(1, 1, 1), true, false);
    chain_->setBasePos(btVector3(btScalar(-1.5), btScalar(1.5), 0));
    const btVector3 half(btScalar(0.15), 0, 0);
    for (int i = 0; i < kLinks; ++i) {
      chain_->setupRevolute(i, 1, btVector3(btScalar(0.01), btScalar(0.01), btScalar(0.01)), i - 1,
                            btQuaternion::getIdentity(), btVector3(0, 0, 1), half, half, true);
    }
    chain_->finalizeMultiDof();
    world_.addMultiBody(chain_.get());
    for (int i = 0; i < kLinks; ++i) add_collider(i);
  }
  ~MultiBodyWorld() override {
    for (const auto& collider : colliders_) world_.removeCollisionObject(collider.get());
    world_.removeMultiBody(chain_.get());
  }
  btDiscreteDynamicsWorld& world() override { return world_; }

 private:
  void add_collider(int link) {
    colliders_.push_back(std::make_unique<btMultiBodyLinkCollider>(chain_.get(), link));
    colliders_.back()->setCollisionShape(&link_shape_);
    chain_->getLink(link).m_collider = colliders_.back().get();
    world_.addCollisionObject(colliders_.back().get());
  }
  void add_others(StateHash& hash) override {
    for (int i = 0; i < chain_->getNumLinks(); ++i) {
      hash.add(chain_->getJointPos(i));
      hash.add(chain_->getJointVel(i));
    }
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btBoxShape link_shape_{btVector3(btScalar(0.14), btScalar(0.05), btScalar(0.05))};
  std::unique_ptr<btMultiBody> chain_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
};

template <class Kind>
class EveryWorld : public testing::Test {};
using Kinds = testing::Types<DiscreteWorld, SoftWorld, MultiBodyWorld>;
TYPED_TEST_SUITE(EveryWorld, Kinds);

constexpr int kTicks = 300;

TYPED_TEST(EveryWorld, KeepsItsBitsWithAnIdleBridge) {
  TypeParam plain, bridged;
  const std::uint64_t start = plain.hash();
  CoSimulation simulation(bridged.world());
  for (int tick = 0; tick < kTicks; ++tick) {
    plain.step();
    bridged.step();
    ASSERT_EQ(plain.hash(), bridged.hash()) << "tick " << tick;
  }
  EXPECT_NE(plain.hash(), start);
}

TYPED_TEST(EveryWorld, KeepsItsBitsWhenABridgeComesAndGoes) {
  TypeParam plain, visited;
  std::unique_ptr<CoSimulation> simulation;
  for (int tick = 0; tick < kTicks; ++tick) {
    if (tick == 50) simulation = std::make_unique<CoSimulation>(visited.world());
    if (tick == 150) simulation.reset();
    plain.step();
    visited.step();
    ASSERT_EQ(plain.hash(), visited.hash()) << "tick " << tick;
  }
}

struct Calls {
  int before = 0, after = 0;
};
void count_before(btDynamicsWorld* world, btScalar) {
  ++static_cast<Calls*>(world->getWorldUserInfo())->before;
}
void count_after(btDynamicsWorld* world, btScalar) {
  ++static_cast<Calls*>(world->getWorldUserInfo())->after;
}

// Objects come, fly, land and go, while the game's own slots are all taken.
TYPED_TEST(EveryWorld, KeepsItsCallbacksAndPointers) {
  TypeParam busy;
  btDiscreteDynamicsWorld& world = busy.world();
  Calls calls;
  world.setInternalTickCallback(count_before, &calls, true);
  world.setInternalTickCallback(count_after, &calls, false);
  std::vector<int> mine(static_cast<std::size_t>(world.getNumCollisionObjects()));
  for (std::size_t i = 0; i < mine.size(); ++i) {
    btCollisionObject* object = world.getCollisionObjectArray()[static_cast<int>(i)];
    object->setUserPointer(&mine[i]);
    object->setUserIndex(static_cast<int>(i));
  }
  const auto expect_pointers = [&] {
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const btCollisionObject* object = world.getCollisionObjectArray()[static_cast<int>(i)];
      ASSERT_EQ(object->getUserPointer(), &mine[i]);
      ASSERT_EQ(object->getUserIndex(), static_cast<int>(i));
    }
    ASSERT_EQ(world.getWorldUserInfo(), &calls);
  };
  {
    CoSimulation simulation(world);
    simulation.add(make_block({.modulus = 1e6, .internal_damping = 100.0}, {-3.0, 0.4, 0.0}));
    for (int tick = 0; tick < 100; ++tick) busy.step();
    EXPECT_FALSE(simulation.failure());
    EXPECT_GT(simulation.counters().to_flexible, 0u);
    expect_pointers();
  }
  expect_pointers();
  EXPECT_EQ(static_cast<std::size_t>(world.getNumCollisionObjects()), mine.size());
  for (int tick = 0; tick < 10; ++tick) busy.step();
  EXPECT_EQ(calls.before, 110);
  EXPECT_EQ(calls.after, 110);
}

// With a flexible piece in the middle of the heap, and a solver that was the game's own.
TYPED_TEST(EveryWorld, RunsOnWhenABridgeGoesInMidRun) {
  TypeParam busy;
  btConstraintSolver* const solver = busy.world().getConstraintSolver();
  const int objects = busy.world().getNumCollisionObjects();
  {
    CoSimulation simulation(busy.world(), settings_for(Representation::kAlwaysFlexible));
    simulation.add(make_block({.modulus = 1e6}, {0.0, 1.5, 0.0}));
    for (int tick = 0; tick < 60; ++tick) busy.step();
    EXPECT_FALSE(simulation.failure());
    EXPECT_NE(busy.world().getConstraintSolver(), solver);
  }
  EXPECT_EQ(busy.world().getConstraintSolver(), solver);
  EXPECT_EQ(busy.world().getNumCollisionObjects(), objects);
  const std::uint64_t then = busy.hash();
  for (int tick = 0; tick < 60; ++tick) busy.step();
  EXPECT_NE(busy.hash(), then);
}

// A soft body is no shape for a lattice: that is no reason to stop the lattices.
TEST(SoftWorldWithABlock, ThrownAtTheClothGoesOn) {
  SoftWorld soft;
  CoSimulation simulation(soft.world());
  simulation.add(make_block({}, {0.0, 5.0, 0.0}, {0.0, -40.0, 0.0}));
  for (int n = 0; n < 60; ++n) soft.step();
  EXPECT_FALSE(simulation.failure()) << simulation.failure()->text();
}

}  // namespace
}  // namespace limber::bullet::test
