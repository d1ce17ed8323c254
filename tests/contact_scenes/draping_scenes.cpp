#include <algorithm>
#include <numbers>

#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr double kBeamHeight = 1.4;  // m, of its axis
constexpr double kBeamHalf = 0.05;   // m

// The height of the rope where it crosses the beam's axis; below all where it does not.
double crossing_height(const PhysicalModel& rope) {
  double height = -kNoLimit;
  for (const Edge& edge : rope.geometry.edges) {
    const Vec3 a = rope.geometry.points[edge.a], b = rope.geometry.points[edge.b];
    if (a.x() * b.x() > 0.0 || a.x() == b.x()) continue;
    height = std::max(height, a.y() + (b.y() - a.y()) * a.x() / (a.x() - b.x()));
  }
  return height;
}

Scene rope_over(const std::string& name, const RigidSpec& beam) {
  Scene scene{.name = name};
  scene.rigid = {ground(), beam};
  scene.flexible = {make_rope({0.0, kBeamHeight + kBeamHalf + 0.02, 0.0}, 2.0)};
  scene.seconds = 8.0;
  scene.limits = {.penetration = 0.5 * kBeamHalf, .rest_speed = kAtRest};
  scene.demands = {
      {.what = "rope under the beam's axis, m", .most = 0.0, .value = [](const SceneState& state) {
         return kBeamHeight - crossing_height(state.flexible[0]);
       }}};
  return scene;
}

std::vector<Scene> ropes() {
  const Vec3 axis(0.0, kBeamHeight, 0.0);
  const Eigen::Quaterniond lying(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
  return {rope_over("rope over a square beam",
                    {.shape = box({2.0 * kBeamHalf, 2.0 * kBeamHalf, 1.0}), .position = axis}),
          rope_over("rope over a round beam",
                    {.shape = cylinder(kBeamHalf, 1.0), .position = axis, .rotation = lying})};
}

Scene sheet_over_sphere() {
  constexpr double kRadius = 0.3, kHeight = 0.8;  // m, of the ball's middle
  Scene scene{.name = "sheet over a sphere"};
  scene.rigid = {ground(), {.shape = sphere(kRadius), .position = {0.0, kHeight, 0.0}}};
  scene.flexible = {make_sheet({.stretch_stiffness = 2e4, .pinned_border = false},
                               {0.0, kHeight + kRadius + 0.02, 0.0})};
  scene.seconds = 8.0;
  scene.limits = {.penetration = 0.025, .rest_speed = kAtRest};
  scene.demands = {
      {.what = "sheet under the top mm", .most = 25.0, .value = [=](const SceneState& state) {
         return 1e3 * (kHeight + kRadius - highest(state.flexible[0]));
       }}};
  return scene;
}

}  // namespace

std::vector<Scene> draping_scenes() {
  std::vector<Scene> scenes = ropes();
  scenes.push_back(sheet_over_sphere());
  return scenes;
}

}  // namespace limber::bullet::test
