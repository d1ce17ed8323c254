#include <fmt/format.h>

#include <algorithm>

#include "tests/bridge/measure.h"
#include "tests/bridge/world.h"
#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"

namespace limber::bullet::test {
namespace {

constexpr double kCollisionSpeeds[] = {5.0, 20.0, 50.0};  // m/s
constexpr double kCoarseSide = 0.3;                       // m, of the coarse block
constexpr double kCoarse = kCoarseSide / 3;               // m, its spacing

Demand does_not_pass() {
  return {.what = "passed by mm", .most = 0.0, .value = [](const SceneState& state) {
            return 1e3 *
                   (sums_of(state.flexible[0]).centre() - sums_of(state.flexible[1]).centre()).x();
          }};
}

// The first flies along x at the second, past its middle and past its points. No gravity.
Scene collision(const std::string& name, PhysicalModel moving, double speed) {
  set_in_motion(moving, {speed, 0.0, 0.0}, Vec3::Zero());
  return {.name = fmt::format("{} at {:g} m/s", name, speed),
          .flexible = {std::move(moving), make_block(toy_block(kCoarseSide, 3, 1e6), Vec3::Zero())},
          .seconds = 0.2,
          .gravity = 0.0,
          .limits = {.penetration = 0.5 * kCoarse, .momentum_error = by_precision(1e-6, 1e-12)},
          .demands = {does_not_pass()}};
}

PhysicalModel fine_block() {
  return make_block(toy_block(kCoarseSide, 8, 1e6), {-kCoarseSide - 0.03, 0.04, 0.03});
}

PhysicalModel flying_needle() {
  PhysicalModel needle = make_needle({0.0, -0.2, 0.0});
  const Mat3 lying = Eigen::AngleAxisd(-0.5 * M_PI, Vec3::UnitZ()).toRotationMatrix();
  place(needle, lying, {-0.5 * kCoarseSide - 0.2 - 0.03, 0.01, 0.005});
  return needle;
}

}  // namespace

std::vector<Scene> collision_scenes() {
  std::vector<Scene> scenes;
  for (double v : kCollisionSpeeds)
    scenes.push_back(collision("fine on coarse block", fine_block(), v));
  for (double v : kCollisionSpeeds)
    scenes.push_back(collision("needle on a block", flying_needle(), v));
  return scenes;
}

}  // namespace limber::bullet::test
