#include <fmt/format.h>

#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr double kRatios[] = {1e-4, 1e-2, 1.0, 1e2, 1e4};
constexpr double kBoxSide = 0.3;      // m
constexpr double kCushionDrop = 0.1;  // m
constexpr double kCushionSpacing = kCushionSide / 5;

const Limits kLimits = {.penetration = 0.5 * kCushionSpacing, .rest_speed = kAtRest};

Scene box_on_cushion(double ratio) {
  const double height = kCushionSide + kCushionDrop + 0.5 * kBoxSide;
  Scene scene{.name = fmt::format("box of {:g} x its mass on a cushion", ratio)};
  scene.rigid = {ground(),
                 {.shape = box(Vec3::Constant(kBoxSide)),
                  .mass = ratio * kCushionMass,
                  .position = {0.0, height, 0.0}}};
  scene.flexible = {cushion({0.0, 0.5 * kCushionSide, 0.0})};
  scene.limits = kLimits;
  scene.demands = {stays_above_ground(1), lattice_stays_above_ground(0, kCushionSpacing),
                   is_not_thrown_up(1, height)};
  return scene;
}

Scene cushion_on_box(double ratio) {
  const double height = kBoxSide + kCushionDrop + 0.5 * kCushionSide;
  Scene scene{.name = fmt::format("cushion on a box, {:g} x its mass", ratio)};
  scene.rigid = {ground(),
                 {.shape = box(Vec3::Constant(kBoxSide)),
                  .mass = kCushionMass / ratio,
                  .position = {0.0, 0.5 * kBoxSide, 0.0}}};
  scene.flexible = {cushion({0.0, height, 0.0})};
  scene.limits = kLimits;
  scene.demands = {stays_above_ground(1), lattice_stays_above_ground(0, kCushionSpacing),
                   is_not_thrown_up(1, height)};
  return scene;
}

}  // namespace

std::vector<Scene> mass_ratio_scenes() {
  std::vector<Scene> scenes;
  for (double ratio : kRatios) scenes.push_back(box_on_cushion(ratio));
  for (double ratio : kRatios) scenes.push_back(cushion_on_box(ratio));
  return scenes;
}

}  // namespace limber::bullet::test
