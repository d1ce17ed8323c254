#include <cmath>

#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr double kLandingSide = 0.3;  // m, of the block
constexpr double kLandingDrop = 0.2;  // m

// The block a little aslant above what reaches up to `top`.
Scene landing(const std::string& name, std::vector<RigidSpec> rigid, double top) {
  const Block block = toy_block(kLandingSide, 3, 1e5);
  PhysicalModel model = make_block(block, Vec3::Zero());
  const Mat3 aslant = Eigen::AngleAxisd(0.15, Vec3(1.0, 0.0, 1.0).normalized()).toRotationMatrix();
  place(model, aslant, {0.03, top + kLandingDrop + 0.6 * kLandingSide, 0.02});
  Scene scene{.name = name};
  scene.rigid = std::move(rigid);
  scene.flexible = {model};
  scene.seconds = 4.0;
  scene.limits = {.penetration = 0.5 * block.spacing, .rest_speed = kAtRest};
  return scene;
}

// Something 0.3 m high that stands on the floor.
Scene landing_on(const std::string& name, const Shape& shape) {
  constexpr double kHeight = 0.3;  // m
  Scene scene =
      landing("block on a " + name,
              {ground(), {.shape = shape, .position = {0.0, 0.5 * kHeight, 0.0}}}, kHeight);
  scene.demands = {lattice_stays_above_ground(0, kLandingSide / 3)};
  return scene;
}

// Hills of 5 cm about y = 0.1 m, half a metre from top to bottom.
double hills(double x, double z) { return 0.1 + 0.05 * std::sin(6.0 * x) * std::cos(6.0 * z); }
constexpr double kReliefSide = 4.0;  // m
constexpr int kReliefCells = 40;

Scene landing_on_relief(const std::string& name, const Shape& relief) {
  Scene scene = landing("block on a " + name, {{.shape = relief}}, 0.15);
  scene.demands = {lattice_stays_above_ground(0, 0.0)};
  return scene;
}

Shape truncated_pyramid() {
  std::vector<Vec3> corners;
  for (double x : {-1.0, 1.0}) {
    for (double z : {-1.0, 1.0}) {
      corners.emplace_back(0.3 * x, -0.15, 0.3 * z);
      corners.emplace_back(0.15 * x, 0.15, 0.15 * z);
    }
  }
  return hull(corners);
}

Shape steps() {
  return compound({{box({0.6, 0.1, 0.6}), {0.0, -0.1, 0.0}},
                   {box({0.3, 0.2, 0.6}), {-0.15, 0.05, 0.0}},
                   {sphere(0.1), {0.15, 0.0, 0.0}}});
}

}  // namespace

std::vector<Scene> landing_scenes() {
  return {landing_on_relief("triangle mesh", mesh_floor(hills, kReliefSide, kReliefCells)),
          landing_on_relief("scaled mesh", scaled_mesh_floor(hills, kReliefSide, kReliefCells)),
          landing_on_relief("heightfield", heightfield(hills, kReliefSide, kReliefCells)),
          landing_on("compound", steps()),
          landing_on("hull", truncated_pyramid()),
          landing_on("cylinder", cylinder(0.2, 0.3)),
          landing_on("cone", cone(0.2, 0.3)),
          landing_on("capsule", capsule(0.1, 0.3))};
}

}  // namespace limber::bullet::test
