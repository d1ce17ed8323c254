#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// A character of Bullet's, which finds its way by sweeps, on a lattice.

namespace limber::bullet::test {
namespace {

class Character {
 public:
  Character(World& world, const Vec3& at) : world_(world) {
    world->getPairCache()->setInternalGhostPairCallback(&ghost_pairs_);
    ghost_.setCollisionShape(&shape_);
    ghost_.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
    ghost_.setWorldTransform(btTransform(btQuaternion::getIdentity(), to_bullet(at)));
    world->addCollisionObject(&ghost_, btBroadphaseProxy::CharacterFilter);
    world->addAction(&controller_);
  }
  ~Character() {
    world_->removeAction(&controller_);
    world_->removeCollisionObject(&ghost_);
  }
  void walk(const Vec3& per_tick) { controller_.setWalkDirection(to_bullet(per_tick)); }
  Vec3 place() const { return from_bullet(ghost_.getWorldTransform().getOrigin()); }

 private:
  World& world_;
  btGhostPairCallback ghost_pairs_;
  btCapsuleShape shape_{btScalar(0.2), btScalar(0.6)};  // 1 m high
  btPairCachingGhostObject ghost_;
  btKinematicCharacterController controller_{&ghost_, &shape_, btScalar(0.1), btVector3(0, 1, 0)};
};

// A stiff deck of 2 m, its top at y = 0, that pins hold at its ends.
PhysicalModel deck() {
  PhysicalModel model =
      make_block({.cells = {20, 1, 6}, .mass = 20.0, .modulus = 1e8}, {0.0, -0.05, 0.0});
  for (PointId p : ids_of(model.points)) {
    model.points[p].pinned = std::abs(model.geometry.points[p].x()) > 0.99;
  }
  return model;
}

TEST(Character, WalksOverALatticeAndFallsOffItsEnd) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(deck());
  Character character(world, {-0.8, 0.6, 0.0});
  world.run(0.5, kTick);
  // Bullet's characters keep a few centimetres of their own off the ground.
  EXPECT_NEAR(character.place().y(), 0.5, 0.05);
  character.walk({0.02, 0.0, 0.0});
  world.run(1.0, kTick);
  EXPECT_NEAR(character.place().x(), 0.4, 0.05);
  EXPECT_NEAR(character.place().y(), 0.5, 0.05);
  world.run(1.0, kTick);
  EXPECT_LT(character.place().y(), 0.0);
}

}  // namespace
}  // namespace limber::bullet::test
