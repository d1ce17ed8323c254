#include <fmt/format.h>

#include <algorithm>

#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr double kCubeSide = 0.3;  // m, of the cube
constexpr double kJawDepth = 0.2;  // m
constexpr double kClosing = 1.0;   // s, and as long for opening
constexpr double kHolding = 0.5;   // s

// m, of each jaw's face from the middle.
double face_at(double time, double share) {
  const double open = 0.5 * kCubeSide + 0.01, closed = 0.5 * share * kCubeSide;
  const double until_open = 2.0 * kClosing + kHolding - time;
  return open + (closed - open) * std::clamp(std::min(time, until_open) / kClosing, 0.0, 1.0);
}

RigidSpec jaw(double side, double share) {
  // Down to below the ground: points sink into that a little, and would slip under.
  return {.shape = box({kJawDepth, 1.2, 1.0}), .path = [=](double time) -> Vec3 {
            return {side * (face_at(time, share) + 0.5 * kJawDepth), 0.4, 0.0};
          }};
}

Demand stays_between(double share, double spacing) {
  return {
      .what = "beyond the jaws mm", .most = 0.5e3 * spacing, .value = [=](const SceneState& state) {
        double farthest = 0.0;
        for (const Vec3& x : state.flexible[0].geometry.points) {
          farthest = std::max(farthest, std::abs(x.x()));
        }
        return 1e3 * (farthest - face_at(state.time, share));
      }};
}

Demand returns() {
  return {.what = "width lost %",
          .most = 5.0,
          .when = Demand::When::kAtEnd,
          .value = [](const SceneState& state) {
            const auto by_x = [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); };
            const auto& points = state.flexible[0].geometry.points;
            const auto [low, high] = std::minmax_element(points.begin(), points.end(), by_x);
            return 100.0 * std::abs((high->x() - low->x()) / kCubeSide - 1.0);
          }};
}

Scene vice(double share) {
  const Block cube = toy_block(kCubeSide, 5, 1e5);
  Scene scene{.name = fmt::format("cube in a vice, to {:g} % of its size", 100.0 * share)};
  scene.rigid = {ground(), jaw(-1.0, share), jaw(1.0, share)};
  scene.flexible = {make_block(cube, {0.0, 0.5 * kCubeSide, 0.0})};
  scene.seconds = 4.5;
  // The jaws do work.
  scene.limits = {
      .penetration = 0.5 * cube.spacing, .energy_rise = kNoLimit, .rest_speed = kAtRest};
  scene.demands = {stays_between(share, cube.spacing), lattice_stays_above_ground(0, cube.spacing),
                   returns()};
  return scene;
}

}  // namespace

std::vector<Scene> vice_scenes() { return {vice(0.5), vice(0.1)}; }

}  // namespace limber::bullet::test
