#include <algorithm>

#include "core/model/random.h"
#include "tests/bridge/measure.h"
#include "tests/contact_scenes/demands.h"
#include "tests/contact_scenes/flexible_models.h"
#include "tests/contact_scenes/scenes.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {
namespace {

constexpr double kHalf = 1.5;    // m, of the open box
constexpr double kHeight = 8.0;  // m: all start inside
constexpr double kWall = 0.5;    // m, thick
constexpr double kPitch = 0.55;  // m, of the grid on which they start
constexpr int kRow = 5;
constexpr int kOnGrid = 199;  // and a sheet on top

std::vector<RigidSpec> open_box() {
  const double middle = kHalf + 0.5 * kWall, side = 2.0 * kHalf + 2.0 * kWall;
  std::vector<RigidSpec> walls = {ground()};
  for (double sign : {-1.0, 1.0}) {
    walls.push_back(
        {.shape = box({kWall, kHeight, side}), .position = {sign * middle, 0.5 * kHeight, 0.0}});
    walls.push_back(
        {.shape = box({side, kHeight, kWall}), .position = {0.0, 0.5 * kHeight, sign * middle}});
  }
  return walls;
}

Vec3 grid_place(int i, Random& random) {
  const Vec3 cell(i % kRow - 2, i / (kRow * kRow) + 1, i / kRow % kRow - 2);
  return kPitch * cell + Vec3(random.in(-0.03, 0.03), 0.0, random.in(-0.03, 0.03));
}

Shape octahedron(double radius) {
  std::vector<Vec3> corners;
  for (int axis = 0; axis < 3; ++axis) {
    corners.emplace_back(radius * Vec3::Unit(axis));
    corners.emplace_back(-radius * Vec3::Unit(axis));
  }
  return hull(corners);
}

// Of four kinds, 0.2 to 0.4 m large.
RigidSpec rigid_body(int i, const Vec3& place, Random& random) {
  const double size = random.in(0.2, 0.4);
  const Shape shapes[] = {box({size, 0.7 * size, 0.5 * size}), sphere(0.5 * size),
                          capsule(0.25 * size, size), octahedron(0.5 * size)};
  const Vec3 axis(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
  return {.shape = shapes[i % 4],
          .mass = random.in(0.5, 2.0),
          .position = place,
          .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(random.in(0, 3), axis.normalized()))};
}

// Every eighth is flexible: blocks, and a rope for two of them.
void add_bodies(Scene& scene) {
  Random random(1);
  for (int i = 0; i < kOnGrid; ++i) {
    const Vec3 place = grid_place(i, random);
    if (i % 8 != 7)
      scene.rigid.push_back(rigid_body(i % 8, place, random));
    else if (i / 8 % 3 == 2)
      scene.flexible.push_back(make_rope(place, 0.5));
    else
      scene.flexible.push_back(make_block(toy_block(0.3, 3, 1e5), place));
  }
  const double above = kPitch * (kOnGrid / (kRow * kRow) + 2);
  scene.flexible.push_back(make_sheet(
      {.cells = 10, .stretch_stiffness = 2e4, .pinned_border = false}, {0.0, above, 0.0}));
}

double outside(const Vec3& x) {
  return std::max({std::abs(x.x()) - kHalf, std::abs(x.z()) - kHalf, -x.y()});
}

// m, how far the centre of any body is outside.
double farthest_outside(const SceneState& state) {
  double distance = -kNoLimit;
  for (const PhysicalModel& model : state.flexible) {
    distance = std::max(distance, outside(sums_of(model).centre()));
  }
  for (const btRigidBody* body : state.rigid) {
    if (!body->isStaticObject()) distance = std::max(distance, outside(centre_of(*body)));
  }
  return distance;
}

}  // namespace

std::vector<Scene> crowd_scenes() {
  Scene scene{.name = "200 bodies in a box"};
  scene.rigid = open_box();
  add_bodies(scene);
  scene.seconds = 60.0;
  scene.frames_between = 30;
  scene.representation = Representation::kSwitching;
  scene.limits = {.rest_speed = kAtRest};
  scene.demands = {{.what = "outside the box, m", .most = 0.0, .value = farthest_outside}};
  scene.slow = true;
  return {scene};
}

}  // namespace limber::bullet::test
