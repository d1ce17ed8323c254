#include <fmt/format.h>

#include "tests/bridge/measure.h"
#include "tests/bridge/world.h"
#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr double kBallSpeeds[] = {10.0, 50.0, 200.0};  // m/s
constexpr double kRadius = 0.1;                        // m
constexpr double kMass = 1.0;                          // kg

Scene ball_on_sheet(double speed, double strain_at_break) {
  const bool breakable = strain_at_break < kUnbreakable;
  const SquareSheet sheet{.strain_at_break = strain_at_break};
  const Vec3 above(0.02, 1.0 + kRadius + 0.05, 0.03);
  return {.name = fmt::format("ball at {:g} m/s, {} sheet", speed,
                              breakable ? "breakable" : "unbreakable"),
          .rigid = {{.shape = sphere(kRadius),
                     .mass = kMass,
                     .position = above,
                     .velocity = {0.0, -speed, 0.0}}},
          .flexible = {make_sheet(sheet, {0.0, 1.0, 0.0})},
          .seconds = 0.5,
          .limits = {.penetration = breakable ? kNoLimit : 0.5 * kRadius},
          .demands = {does_not_pass_sheet(0, 0), is_slowed(0, speed, above.y())}};
}

// Along x, beyond every point of an unbroken cube.
Demand does_not_pass_cube() {
  return {.what = "passed unbroken, m", .most = 0.0, .value = [](const SceneState& state) {
            double farthest = -kNoLimit;
            for (const Vec3& x : state.flexible[0].geometry.points) {
              farthest = std::max(farthest, x.x());
            }
            return centre_of(*state.rigid[0]).x() - farthest;
          }};
}

Scene ball_on_cube(double speed) {
  constexpr double kSide = 0.5;  // m
  return {.name = fmt::format("ball at {:g} m/s, free cube", speed),
          .rigid = {{.shape = sphere(kRadius),
                     .mass = kMass,
                     .position = {-0.5 * kSide - kRadius - 0.05, 0.06, 0.03},
                     .velocity = {speed, 0.0, 0.0}}},
          .flexible = {make_block(toy_block(kSide, 5, 1e6), Vec3::Zero())},
          .seconds = 0.2,
          .gravity = 0.0,
          .limits = {.penetration = 0.5 * kRadius, .momentum_error = by_precision(1e-6, 1e-12)},
          .demands = {does_not_pass_cube()}};
}

}  // namespace

std::vector<Scene> ball_scenes() {
  std::vector<Scene> scenes;
  for (double speed : kBallSpeeds) scenes.push_back(ball_on_sheet(speed, kUnbreakable));
  for (double speed : kBallSpeeds) scenes.push_back(ball_on_sheet(speed, 0.1));
  for (double speed : kBallSpeeds) scenes.push_back(ball_on_cube(speed));
  return scenes;
}

}  // namespace limber::bullet::test
