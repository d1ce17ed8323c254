#include <numbers>

#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr double kCoarseSpacing = 0.1;  // m, of block and sheet
constexpr double kCoarseDrop = 0.2;     // m
constexpr double kTop = 0.5;            // m

RigidSpec rod() {
  const Eigen::Quaterniond lying(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
  return {.shape = capsule(0.01, 0.6),
          .mass = 0.5,
          .position = {0.01, kTop + kCoarseDrop, 0.0},
          .rotation = lying};
}

Scene rod_on_block() {
  Scene scene{.name = "rod of 2 cm on a block with 10 cm cells"};
  scene.rigid = {ground(), rod()};
  scene.flexible = {make_block(toy_block(kTop, 5, 1e5), {0.0, 0.5 * kTop, 0.0})};
  scene.limits = {.penetration = 0.5 * kCoarseSpacing, .rest_speed = kAtRest};
  scene.demands = {stays_above_ground(1)};
  return scene;
}

// Pinned, 10 cm cells; its points are 5 cm beside the middle, where things fall.
Scene on_coarse_sheet(const std::string& name, const RigidSpec& body) {
  Scene scene{.name = name};
  scene.rigid = {body};
  scene.flexible = {make_sheet({.side = 1.1, .cells = 11}, {0.0, kTop, 0.0})};
  scene.limits.penetration = 0.5 * kCoarseSpacing;
  scene.demands = {does_not_pass_sheet(0, 0)};
  return scene;
}

Scene corner_on_sheet() {
  const Eigen::Quaterniond on_its_corner =
      Eigen::Quaterniond::FromTwoVectors(Vec3(1.0, 1.0, 1.0), -Vec3::UnitY());
  constexpr double kSide = 0.2;  // m
  const double half_diagonal = 0.5 * kSide * std::sqrt(3.0);
  return on_coarse_sheet("box corner on a sheet with 10 cm cells",
                         {.shape = box(Vec3::Constant(kSide)),
                          .mass = 1.0,
                          .position = {0.01, kTop + half_diagonal + kCoarseDrop, 0.005},
                          .rotation = on_its_corner});
}

}  // namespace

std::vector<Scene> coarse_scenes() {
  return {rod_on_block(), on_coarse_sheet("rod of 2 cm on a sheet with 10 cm cells", rod()),
          corner_on_sheet()};
}

}  // namespace limber::bullet::test
