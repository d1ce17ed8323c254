#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <vector>

#include "tests/contact_scenes/run_scene.h"
#include "tests/contact_scenes/scenes.h"

namespace limber::bullet::test {

// For gtest's messages.
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

namespace {

std::vector<Scene> fast_scenes() {
  std::vector<Scene> scenes = all_scenes();
  std::erase_if(scenes, [](const Scene& scene) { return scene.slow; });
  return scenes;
}

// "ball at 10 m/s, free cube" is BallAt10MSFreeCube.
std::string test_name(const Scene& scene) {
  std::string name;
  bool first = true;
  for (const unsigned char c : scene.name) {
    if (std::isalnum(c)) name += static_cast<char>(first ? std::toupper(c) : c);
    first = !std::isalnum(c);
  }
  return name;
}

// What contact does not do yet: docs/bridge.md has the figures. A scene that starts to meet its
// demands has to leave this list.
const std::set<std::string> kNotMetYet = {
    "box of 1 x its mass on a cushion",     "box of 100 x its mass on a cushion",
    "box of 10000 x its mass on a cushion", "cushion on a box, 0.0001 x its mass",
    "cushion on a box, 0.01 x its mass",    "cushion on a box, 1 x its mass",
    "cushion on a box, 100 x its mass",     "cushion on a box, 10000 x its mass",
    "ball at 200 m/s, unbreakable sheet",   "ball at 200 m/s, free cube",
    "block on a stack of three boxes",      "rigid cylinder, end first, on a block",
};
// Angular momentum to 1.4e-6, where 1e-6 is asked for: what Bullet's numbers round away. And a rope
// that slides on at 0.09 m/s. And a block that lands on
// a cone's tip: 61 mm deep where 50 are asked for (49.9 in an earlier version; the cause is not
// known).
const std::set<std::string> kNotMetInSingle = {"needle on a block at 20 m/s", "block on a cone",
                                               "rope over a square beam"};

bool is_not_met_yet(const Scene& scene) {
  constexpr bool kSingle = sizeof(btScalar) == sizeof(float);
  return kNotMetYet.contains(scene.name) || (kSingle && kNotMetInSingle.contains(scene.name));
}

class ContactScene : public testing::TestWithParam<Scene> {};

TEST_P(ContactScene, MeetsItsDemands) {
  const Measured measured = run_scene(GetParam(), Engine::kLimber);
  if (!is_not_met_yet(GetParam())) {
    EXPECT_TRUE(measured.good()) << measured.verdict();
  } else if (measured.good()) {
    ADD_FAILURE() << "meets its demands: take it off the list";
  } else {
    GTEST_SKIP() << "known not to: " << measured.verdict();
  }
}

// A tick is Bullet's; contact is solved at the substep rate whatever it is.
TEST_P(ContactScene, GainsNoEnergyAtOtherTicks) {
  for (double tick : {1.0 / 30.0, 1.0 / 240.0}) {
    const Measured measured = run_scene(GetParam(), Engine::kLimber, tick);
    EXPECT_EQ(measured.failure, "");
    EXPECT_LE(measured.energy_rise, GetParam().limits.energy_rise * measured.energy_start);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ContactScene, testing::ValuesIn(fast_scenes()),
                         [](const auto& scene) { return test_name(scene.param); });

}  // namespace

}  // namespace limber::bullet::test
