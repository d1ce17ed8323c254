#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr double kNeedleDrop = 0.3;      // m
constexpr double kTilt = 0.02;           // rad: it falls over in the same way everywhere
constexpr double kNeedleSpacing = 0.02;  // m
constexpr double kBlockSide = 0.5;       // m
// Away from the block's points, which are 10 cm apart.
const Vec3 kAim(0.02, kBlockSide + kNeedleDrop, 0.01);

Scene needle_scene(const std::string& name) {
  Scene scene{.name = name};
  scene.rigid = {ground()};
  scene.seconds = 5.0;
  scene.limits = {.penetration = 0.05, .rest_speed = kAtRest};
  return scene;
}

Scene needle_on_floor() {
  Scene scene = needle_scene("flexible needle on the floor");
  scene.flexible = {make_needle({0.0, kNeedleDrop, 0.0}, kTilt)};
  scene.limits.penetration = 0.5 * kNeedleSpacing;
  scene.demands = {lattice_stays_above_ground(0, kNeedleSpacing)};
  return scene;
}

PhysicalModel target() {
  return make_block(toy_block(kBlockSide, 5, 1e5), {0.0, 0.5 * kBlockSide, 0.0});
}

Scene needle_on_block() {
  Scene scene = needle_scene("flexible needle on a block");
  scene.flexible = {target(), make_needle(kAim, kTilt)};
  scene.demands = {lattice_stays_above_ground(1, kNeedleSpacing)};
  return scene;
}

Scene rigid_needle_on_block(const std::string& name, const Shape& shape, double length) {
  Scene scene = needle_scene(name);
  scene.flexible = {target()};
  scene.rigid.push_back({.shape = shape,
                         .mass = 0.1,
                         .position = kAim + Vec3(0.0, 0.5 * length, 0.0),
                         .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(kTilt, Vec3::UnitZ()))});
  scene.demands = {stays_above_ground(1)};
  return scene;
}

}  // namespace

std::vector<Scene> needle_scenes() {
  constexpr double kLength = 0.4, kRadius = 0.01;  // m
  return {needle_on_floor(), needle_on_block(),
          rigid_needle_on_block("rigid capsule, point first, on a block", capsule(kRadius, kLength),
                                kLength),
          rigid_needle_on_block("rigid cylinder, end first, on a block", cylinder(kRadius, kLength),
                                kLength)};
}

}  // namespace limber::bullet::test
