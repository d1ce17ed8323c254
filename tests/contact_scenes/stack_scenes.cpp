#include <algorithm>

#include "tests/bridge/measure.h"
#include "tests/bridge/substep_reference.h"
#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr int kSubsteps = 256;        // a frame, of the reference
constexpr double kImpactSpeed = 3.0;  // m/s, downwards
constexpr double kSeconds = 0.2;
constexpr double kBoxMass = 2.0;     // kg
const Vec3 kBoxSize(0.5, 0.3, 0.5);  // m

Vec3 box_centre(int i) { return {0.0, (i + 0.5) * kBoxSize.y(), 0.0}; }

PhysicalModel falling_block() {
  const Vec3 drift(1.0, -kImpactSpeed, 0.5);
  return make_block({}, {0.12, 3.0 * kBoxSize.y() + 0.16, 0.07}, drift);
}

// Velocities of boxes and lattice at the end, m/s.
std::vector<Vec3> reference_velocities() {
  World world;
  world.add_ground();
  for (int i = 0; i < 3; ++i) world.add_box(0.5 * kBoxSize, kBoxMass, box_centre(i));
  SubstepReference reference(world, falling_block());
  const int steps = static_cast<int>(std::lround(kSeconds / kFrame)) * kSubsteps;
  for (int n = 0; n < steps; ++n) reference.step(kFrame / kSubsteps);
  std::vector<Vec3> velocities = {sums_of(reference.model()).velocity()};
  for (int i = 0; i < 3; ++i) velocities.push_back(sums_of(*world.bodies()[1 + i]).velocity());
  return velocities;
}

Demand follows_the_reference() {
  return {.what = "off the substep reference m/s",
          .most = 0.08 * kImpactSpeed,
          .when = Demand::When::kAtEnd,
          .value = [](const SceneState& state) {
            if (state.time < kSeconds - 0.5 * kFrame) return 0.0;
            const std::vector<Vec3> expected = reference_velocities();
            double worst = (sums_of(state.flexible[0]).velocity() - expected[0]).norm();
            for (int i = 0; i < 3; ++i) {
              const Vec3 velocity = sums_of(*state.rigid[1 + i]).velocity();
              worst = std::max(worst, (velocity - expected[1 + i]).norm());
            }
            return worst;
          }};
}

}  // namespace

std::vector<Scene> stack_scenes() {
  Scene scene{.name = "block on a stack of three boxes"};
  scene.rigid = {ground()};
  for (int i = 0; i < 3; ++i) {
    scene.rigid.push_back({.shape = box(kBoxSize), .mass = kBoxMass, .position = box_centre(i)});
  }
  scene.flexible = {falling_block()};
  scene.seconds = kSeconds;
  scene.limits = {.penetration = 0.05};
  scene.demands = {follows_the_reference()};
  return {scene};
}

}  // namespace limber::bullet::test
