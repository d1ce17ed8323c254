#include <gtest/gtest.h>

#include "tests/contact_scenes/run_scene.h"
#include "tests/contact_scenes/scenes.h"

namespace limber::bullet::test {
namespace {

TEST(Crowd, MeetsItsDemandsAndGainsNoMoreEnergyThanInBullet) {
  for (const Scene& scene : crowd_scenes()) {
    const Measured limber = run_scene(scene, Engine::kLimber);
    const Measured bullet = run_scene(scene, Engine::kBulletSoft);
    EXPECT_TRUE(limber.good()) << limber.verdict();
    EXPECT_LE(limber.energy_rise, bullet.energy_rise);
    EXPECT_LE(limber.energy_climb, bullet.energy_climb);
  }
}

}  // namespace
}  // namespace limber::bullet::test
