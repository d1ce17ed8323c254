#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/model/random.h"
#include "core/modeller/bending_springs.h"
#include "core/modeller/material_table.h"
#include "core/modeller/sheet.h"
#include "core/modeller/thin_material.h"
#include "demos/scenes/scenes.h"

namespace limber::demos {
namespace {

using std::numbers::pi;

// m
constexpr double kLength = 0.07;
constexpr double kWidth = 0.045;
constexpr double kThickness = 1.2e-4;
constexpr double kHollow = 0.012;  // of the blade between its midrib and its edges
constexpr double kDroop = 0.015;   // of the tip and the stalk below the middle

// The blade of a leaf: u from stalk to tip, v across. Bent both ways, so that it is stiff.
Vec3 blade(double u, double v) {
  const double along = 2.0 * u - 1.0, across = 2.0 * v - 1.0;
  const double half_width = 0.5 * kWidth * std::sin(pi * (0.1 + 0.8 * u));
  return {0.5 * kLength * along, kHollow * across * across - kDroop * along * along,
          -half_width * across};
}

PhysicalModel leaf(const std::string& name) {
  SheetProperties properties;
  properties.thickness = kThickness;
  // A plate across the stream, and friction along it (Hoerner, Fluid-Dynamic Drag, 1965, chapters 3
  // and 2; a leaf is small and slow, so the friction is that of a laminar layer).
  properties.faces.normal_drag = 1.2;
  properties.faces.tangential_drag = 0.03;
  const SheetGrid grid{.cells_u = 4, .cells_v = 2, .cells = SheetCells::kTriangles};
  const Material material = material_named("leaf").material;
  PhysicalModel model = with_sheet_material(sheet(blade, grid, name), name, material, properties);
  // Without them only its two bends would keep the blade from folding.
  add_bending_springs(model, {.youngs_modulus = material.effective_modulus(),
                              .thickness = kThickness,
                              .strain_at_break = material.effective_strain_at_break()});
  set_stiffness_proportional_damping(model, material.damping_ratio);
  return model;
}

Mat3 random_attitude(Random& random) {
  const Vec3 axis = random.in_box({Vec3(-1.0, -1.0, -1.0), Vec3(1.0, 1.0, 1.0)});
  return Eigen::AngleAxisd(random.in(0.0, 2.0 * pi), axis.normalized()).toRotationMatrix();
}

Vec3 autumn_colour(Random& random) {
  const Vec3 green(0.25, 0.35, 0.05), yellow(0.85, 0.6, 0.08), red(0.6, 0.08, 0.03);
  const double share = random.in(0.0, 1.0);
  return share < 0.5 ? Vec3(green + 2.0 * share * (yellow - green))
                     : Vec3(yellow + (2.0 * share - 1.0) * (red - yellow));
}

// `speed` half a metre from its axis, m/s; walks through the yard.
FlowPrimitive whirl(double speed) {
  FlowPrimitive vortex;
  vortex.kind = FlowKind::kLineVortex;
  vortex.axis = Vec3::UnitY();
  vortex.position = Track<Vec3>({{0.0, Vec3(-0.4, 0.0, 0.0)},
                                 {3.0, Vec3(0.4, 0.0, 0.3)},
                                 {6.0, Vec3(-0.2, 0.0, -0.3)},
                                 {9.0, Vec3(0.0, 0.0, 0.0)}});
  vortex.strength = 2.0 * pi * 0.5 * speed;
  vortex.core_radius = 0.35;
  return vortex;
}

// `speed` half a metre from the axis of the vortex that it moves with, m/s.
FlowPrimitive inflow(FlowPrimitive vortex, double speed) {
  vortex.kind = FlowKind::kLineSource;
  vortex.strength = -2.0 * pi * 0.5 * speed;
  vortex.bounds = {.centre = Vec3::Zero(), .radius = 2.0, .fade = 1.0};
  return vortex;
}

FlowPrimitive updraught(double speed) {
  FlowPrimitive lift;
  lift.direction = Vec3::UnitY();
  lift.strength = Track<double>(
      {{0.0, 0.3 * speed}, {1.0, speed}, {5.0, speed}, {6.0, 0.6 * speed}, {7.0, 1.2 * speed}});
  lift.bounds = {.centre = Vec3(0.0, 0.5, 0.0), .radius = 1.2, .fade = 0.8};
  return lift;
}

// `speed` a metre from it, m/s: pushes out what has come up.
FlowPrimitive lid(double speed) {
  FlowPrimitive source;
  source.kind = FlowKind::kPointSource;
  source.position = Vec3(0.0, 3.0, 0.0);
  source.strength = 4.0 * pi * speed;
  source.core_radius = 0.5;
  return source;
}

FlowPrimitive breeze(double speed) {
  FlowPrimitive turning;
  turning.direction = {1.0, 0.0, 0.3};
  turning.strength = Track<double>({{0.0, speed}, {3.0, -speed}, {6.0, speed}});
  return turning;
}

// The wake of a pillar 0.3 m in radius, moving at `speed`, m/s: a doublet.
FlowPrimitive passer_by(double speed) {
  FlowPrimitive doublet;
  doublet.kind = FlowKind::kLineDoublet;
  doublet.axis = Vec3::UnitY();
  doublet.direction = -Vec3::UnitX();
  doublet.position = Track<Vec3>({{3.0, Vec3(-4.0, 0.0, 0.8)}, {7.0, Vec3(4.0, 0.0, 0.8)}});
  doublet.strength = 2.0 * pi * 0.09 * speed;
  doublet.core_radius = 0.3;
  return doublet;
}

// A small whirlwind: a vortex and a sink that move together carry the leaves in and round, an
// updraught lifts them (they sink at 1.6 m/s), a source above pushes them out again. Beside it a
// breeze that turns, and somebody who passes.
FlowField wind(double speed) {
  const FlowPrimitive vortex = whirl(speed);
  return {{vortex, inflow(vortex, 0.7 * speed), updraught(speed), lid(0.3 * speed),
           breeze(0.1 * speed), passer_by(0.5 * speed)}};
}

Scene build(const ParameterValues& values) {
  Random random(static_cast<std::uint64_t>(std::llround(values.at("seed"))));
  Scene scene;
  scene.name = "leaf_magic";
  scene.seconds = 9.0;
  scene.air = Air{.wind = wind(values.at("wind"))};
  const auto leaves = std::llround(values.at("leaves"));
  for (long long i = 0; i < leaves; ++i) {
    PhysicalModel model = leaf("leaf " + std::to_string(i + 1));
    model.parts[0].surface.colour = autumn_colour(random);
    model.parts[0].surface.specularity = 0.1;
    const Mat3 attitude = random_attitude(random);
    place(model, attitude, random.in_box({Vec3(-1.0, 0.1, -1.0), Vec3(1.0, 2.2, 1.0)}));
    scene.objects.push_back(std::move(model));
  }
  scene.camera = {{0.0, 1.6, 4.6}, {0.0, 1.15, 0.0}, 34.0};
  return scene;
}

}  // namespace

SceneEntry leaf_magic() {
  return {"leaf_magic",
          "leaves float and swirl in wind that is made of moving primitives",
          {{"leaves", 320.0, "", "how many", 1.0, 5000.0},
           {"wind", 3.0, "m/s", "speed that all of the wind is measured by", 0.0, 20.0},
           {"seed", 1.0, "", "of where the leaves start", 0.0, 1e9}},
          build};
}

}  // namespace limber::demos
