#include <gtest/gtest.h>

#include <memory>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Contacts remember from tick to tick where they came in. What the game does to a body in between
// makes that untrue.

namespace limber::bullet::test {
namespace {

constexpr double kPlateTop = 1.0;  // m

struct Scene {
  World world;
  btRigidBody* plate = nullptr;
  std::unique_ptr<CoSimulation> simulation;

  // A block that lies on a thin plate, over the ground.
  Scene() {
    world.add_ground();
    plate = &world.add_box({1.0, 0.01, 1.0}, 0.0, {0.0, kPlateTop - 0.01, 0.0});
    simulation =
        std::make_unique<CoSimulation>(*world, settings_for(Representation::kAlwaysFlexible));
    simulation->add(make_block({}, {0.0, kPlateTop + 0.151, 0.0}));
    world.run(0.5, kTick);
    EXPECT_NEAR(low(), kPlateTop, 0.02);
  }
  double low() const { return lowest_point(simulation->model(0)); }  // m
  void put_plate(const Vec3& centre) {
    btTransform pose = plate->getWorldTransform();
    pose.setOrigin(to_bullet(centre));
    plate->setWorldTransform(pose);
    world->updateSingleAabb(plate);
  }
};

TEST(ContactMemory, APlateThatIsTakenAwayLetsGo) {
  Scene scene;
  scene.put_plate({5.0, kPlateTop, 0.0});
  scene.world.run(1.0, kTick);
  EXPECT_FALSE(scene.simulation->failure());
  EXPECT_NEAR(scene.low(), 0.0, 0.02);
}

TEST(ContactMemory, APlateThatIsPutOverheadLetsGo) {
  Scene scene;
  scene.put_plate({0.0, kPlateTop + 0.6, 0.0});
  scene.world.run(1.0, kTick);
  EXPECT_FALSE(scene.simulation->failure());
  EXPECT_NEAR(scene.low(), 0.0, 0.02);
}

// Its contacts were in the world's frame while it was at rest and are in its own now.
TEST(ContactMemory, ALiftThatStartsTakesItsLoadAlong) {
  Scene scene;
  scene.plate->setCollisionFlags(scene.plate->getCollisionFlags() |
                                 btCollisionObject::CF_KINEMATIC_OBJECT);
  scene.plate->setActivationState(DISABLE_DEACTIVATION);
  double height = kPlateTop;
  for (int tick = 0; tick < 60; ++tick) {
    height += 0.5 * kTick;
    scene.put_plate({0.0, height - 0.01, 0.0});
    scene.world.step(kTick);
  }
  EXPECT_FALSE(scene.simulation->failure());
  EXPECT_NEAR(scene.low(), height, 0.03);
}

}  // namespace
}  // namespace limber::bullet::test
