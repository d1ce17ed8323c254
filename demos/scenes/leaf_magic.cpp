#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "core/model/errors.h"
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
  return with_sheet_material(sheet(blade, grid, name), name, material_named("leaf").material,
                             properties);
}

// Independent of the standard library's distributions, which differ between platforms.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) * 0x1p-64;
  }
  Vec3 in_box(const Vec3& low, const Vec3& high) {
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis) at[axis] = in(low[axis], high[axis]);
    return at;
  }

 private:
  std::mt19937_64 engine_;
};

Mat3 random_attitude(Random& random) {
  const Vec3 axis = random.in_box({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0});
  return Eigen::AngleAxisd(random.in(0.0, 2.0 * pi), axis.normalized()).toRotationMatrix();
}

Vec3 autumn_colour(Random& random) {
  const Vec3 green(0.25, 0.35, 0.05), yellow(0.85, 0.6, 0.08), red(0.6, 0.08, 0.03);
  const double share = random.in(0.0, 1.0);
  return share < 0.5 ? Vec3(green + 2.0 * share * (yellow - green))
                     : Vec3(yellow + (2.0 * share - 1.0) * (red - yellow));
}

// A small whirlwind that walks through the yard: a vortex and a sink that move together carry the
// leaves in and round, an updraught lifts them (they sink at 1.6 m/s), a source above pushes them
// out again. Beside it a breeze that turns, and the wake of something that passes: a doublet.
FlowField wind(double speed) {
  const Track<Vec3> walk({{0.0, Vec3(-0.4, 0.0, 0.0)},
                          {3.0, Vec3(0.4, 0.0, 0.3)},
                          {6.0, Vec3(-0.2, 0.0, -0.3)},
                          {9.0, Vec3(0.0, 0.0, 0.0)}});
  FlowPrimitive whirl;
  whirl.kind = FlowKind::kLineVortex;
  whirl.axis = Vec3::UnitY();
  whirl.position = walk;
  whirl.strength = 2.0 * pi * 0.5 * speed;  // `speed` half a metre from its axis
  whirl.core_radius = 0.35;

  FlowPrimitive inflow = whirl;
  inflow.kind = FlowKind::kLineSource;
  inflow.strength = -0.7 * 2.0 * pi * 0.5 * speed;
  inflow.bounds = {.centre = Vec3::Zero(), .radius = 2.0, .fade = 1.0};

  FlowPrimitive updraught;
  updraught.direction = Vec3::UnitY();
  updraught.strength = Track<double>({{0.0, 0.3 * speed}, {1.0, speed}, {5.0, speed},
                                      {6.0, 0.6 * speed}, {7.0, 1.2 * speed}});
  updraught.bounds = {.centre = Vec3(0.0, 0.5, 0.0), .radius = 1.2, .fade = 0.8};

  FlowPrimitive lid;
  lid.kind = FlowKind::kPointSource;
  lid.position = Vec3(0.0, 3.0, 0.0);
  lid.strength = 4.0 * pi * 0.3 * speed;  // 0.3 of `speed` a metre from it
  lid.core_radius = 0.5;

  FlowPrimitive breeze;
  breeze.direction = {1.0, 0.0, 0.3};
  breeze.strength = Track<double>({{0.0, 0.1 * speed}, {3.0, -0.1 * speed}, {6.0, 0.1 * speed}});

  FlowPrimitive passer_by;
  passer_by.kind = FlowKind::kLineDoublet;
  passer_by.axis = Vec3::UnitY();
  passer_by.direction = -Vec3::UnitX();
  passer_by.position = Track<Vec3>({{3.0, Vec3(-4.0, 0.0, 0.8)}, {7.0, Vec3(4.0, 0.0, 0.8)}});
  passer_by.strength = 2.0 * pi * 0.09 * 0.5 * speed;  // a pillar of 0.3 m at half of `speed`
  passer_by.core_radius = 0.3;

  return {{whirl, inflow, updraught, lid, breeze, passer_by}};
}

Scene build(const ParameterValues& values) {
  Random random(static_cast<std::uint64_t>(std::llround(values.at("seed"))));
  Scene scene;
  scene.name = "leaf_magic";
  scene.seconds = 9.0;
  scene.air = Air{.wind = wind(values.at("wind"))};
  const auto leaves = std::llround(values.at("leaves"));
  if (leaves < 1 || leaves > 5000) {
    throw InputError({"scene leaf_magic: parameter leaves", "there would be " + std::to_string(leaves),
                      "give 1 to 5000"});
  }
  for (long long i = 0; i < leaves; ++i) {
    PhysicalModel model = leaf("leaf " + std::to_string(i + 1));
    model.parts[0].surface.colour = autumn_colour(random);
    model.parts[0].surface.specularity = 0.1;
    const Mat3 attitude = random_attitude(random);
    place(model, attitude, random.in_box({-1.0, 0.1, -1.0}, {1.0, 2.2, 1.0}));
    scene.objects.push_back(std::move(model));
  }
  scene.camera = {{0.0, 1.6, 4.6}, {0.0, 1.15, 0.0}, 34.0};
  return scene;
}

}  // namespace

SceneEntry leaf_magic() {
  return {"leaf_magic",
          "leaves float and swirl in wind that is made of moving primitives",
          {{"leaves", 320.0, "", "how many"},
           {"wind", 3.0, "m/s", "speed that all of the wind is measured by"},
           {"seed", 1.0, "", "of where the leaves start"}},
          build};
}

}  // namespace limber::demos
