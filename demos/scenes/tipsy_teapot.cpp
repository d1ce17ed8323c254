#include <algorithm>
#include <cmath>

#include "core/dynamics/rigid_motion.h"
#include "demos/scenes/scenes.h"
#include "demos/scenes/teapot_model.h"

namespace limber::demos {
namespace {

constexpr double kTableTop = 0.75;  // m
constexpr double kTableThickness = 0.04;
constexpr double kEdgeBeyondCentre = 0.10;  // m, from the teapot's centre to the table's edge

double lowest_point(const PhysicalModel& model) {
  double y = model.geometry.points[PointId(0)].y();
  for (const Vec3& p : model.geometry.points) y = std::min(y, p.y());
  return y;
}

RigidBox table() {
  RigidBox box;
  box.name = "table";
  box.half_extents = {0.40, 0.5 * kTableThickness, 0.35};
  box.centre = {kEdgeBeyondCentre - box.half_extents.x(), kTableTop - box.half_extents.y(), 0.0};
  box.colour = {0.45, 0.28, 0.15};
  return box;
}

// Where the pieces that slide off the table's edge come down.
RigidBox wooden_block() {
  RigidBox box;
  box.name = "block";
  box.half_extents = {0.008, 0.09, 0.05};
  box.centre = {0.18, 0.09, 0.0};
  box.mass = 600.0 * 8.0 * box.half_extents.prod();  // spruce, 600 kg/m^3
  box.colour = {0.75, 0.55, 0.3};
  return box;
}

Scene build(const ParameterValues& values) {
  TeapotOptions options;
  options.density = values.at("density");
  options.softening = values.at("softening");
  options.seed = static_cast<std::uint64_t>(std::llround(values.at("seed")));
  PhysicalModel teapot = teapot_model(options);
  place(teapot, Mat3::Identity(), {0.0, values.at("height") - lowest_point(teapot), 0.0});
  set_in_motion(teapot, {values.at("speed"), 0.0, 0.0}, {0.0, 0.0, -values.at("spin")});

  Scene scene;
  scene.name = "tipsy_teapot";
  scene.seconds = 4.0;
  scene.objects.push_back(std::move(teapot));
  scene.boxes = {table(), wooden_block()};
  scene.camera = {{1.05, 1.25, 2.05}, {0.06, 0.66, 0.0}, 36.0};
  return scene;
}

}  // namespace

SceneEntry tipsy_teapot() {
  return {"tipsy_teapot",
          "a teapot falls past a table's edge, breaks, and its pieces come down on the floor",
          {{"height", 1.35, "m", "of the lowest point above the floor", 0.0, 100.0},
           {"speed", 0.3, "m/s", "forward, towards the table's edge", -20.0, 20.0},
           {"spin", 1.5, "rad/s", "forward", -50.0, 50.0},
           {"density", 2400.0, "kg/m^3", "of the ceramic", 100.0, 2e4},
           {"softening", 2000.0, "", "S of the ceramic: modulus / S, strain at break x sqrt S", 1.0,
            1e5},
           {"seed", 1.0, "", "of the flaws", 0.0, 1e9}},
          build};
}

}  // namespace limber::demos
