#include <cmath>

#include "core/modeller/box_lattice.h"
#include "core/modeller/glue_material.h"
#include "core/modeller/material_table.h"
#include "core/modeller/rope.h"
#include "core/modeller/thin_material.h"
#include "core/operators/gluing_operator.h"
#include "demos/scenes/scenes.h"

namespace limber::demos {
namespace {

// m
constexpr double kBar = 2.2;        // height of the bar the ropes hang from
constexpr double kSeatTop = 0.5;    // above the floor
constexpr double kHalfWidth = 0.2;  // between the middle of the seat and a rope
constexpr double kSpacing = 0.05;   // of the seat's cells
constexpr double kKnot = 0.02;      // between a rope's end and the seat
constexpr double kRopeDiameter = 0.012;
constexpr int kRopeSegments = 16;

// A board of 10 x 1 x 4 cells, the ropes above points of it.
PhysicalModel seat(double softening) {
  Material spruce = material_named("spruce").material;
  spruce.softening = softening;
  spruce.damping_ratio = 0.1;  // joints and the person who sits still on it
  const Vec3 low(-0.25, kSeatTop - kSpacing, -0.1);
  PhysicalModel model = with_material(
      box_lattice({10, 1, 4}, Vec3::Constant(kSpacing), low, "seat"), "swing", spruce);
  model.parts[0].surface.colour = {0.6, 0.4, 0.2};
  for (FaceAttributes& face : model.faces) face = {DragLaw::kQuadratic, 1.2, 0.01};
  return model;
}

PhysicalModel hanging_rope(const std::string& name, double x, double softening) {
  Material hemp = material_named("hemp").material;
  hemp.youngs_modulus /= 10.0;   // laid, not drawn: see the remark in the table
  hemp.strain_at_break *= 10.0;  // it bears the same force
  hemp.damping_ratio = 0.2;
  hemp.softening = softening;
  const auto points =
      points_along(polyline({Vec3(x, kBar, 0.0), Vec3(x, kSeatTop + kKnot, 0.0)}), kRopeSegments);
  PhysicalModel model =
      with_rope_material(rope(points, name), name, hemp, round_section(kRopeDiameter));
  model.points[PointId(0)].pinned = true;
  model.parts[0].surface.colour = {0.75, 0.65, 0.4};
  return model;
}

// The knot is as stiff and strong as the seat's wood over one of its squares.
GlueBond knot(const PhysicalModel& seat, double softening) {
  Material spruce = material_named("spruce").material;
  spruce.softening = softening;
  GlueBond bond = bond_like(spruce, kSpacing * kSpacing, kKnot);
  bond.distance = std::hypot(kKnot, kSpacing) + 1e-6;  // the nearest point and its four neighbours
  bond.stiffness /= 5.0;
  bond.damping = 2.0 * std::sqrt(bond.stiffness * seat.points[PointId(0)].mass) * 0.1;
  return bond;
}

// Puffs of wind along the swing's way, one about every period of 2.7 s.
FlowField gusts(double speed) {
  FlowPrimitive gust;
  gust.direction = Vec3::UnitZ();
  std::vector<Track<double>::Key> keys;
  for (int i = 0; i < 6; ++i) {
    const double t = 2.7 * i;
    keys.push_back({t + 0.1, 0.1 * speed});
    keys.push_back({t + 0.6, speed});
    keys.push_back({t + 1.2, 0.1 * speed});
  }
  gust.strength = Track<double>(keys);
  FlowPrimitive eddy;  // a whirl that drifts past and turns the seat
  eddy.kind = FlowKind::kLineVortex;
  eddy.axis = Vec3::UnitY();
  eddy.position = Track<Vec3>({{2.0, Vec3(-3.0, 0.0, 0.4)}, {6.0, Vec3(3.0, 0.0, 0.4)}});
  eddy.strength = 0.5 * speed;
  eddy.core_radius = 0.3;
  return {{gust, eddy}};
}

Scene build(const ParameterValues& values) {
  const double softening = values.at("softening");
  PhysicalModel model = seat(softening);
  const GlueBond bond = knot(model, softening);
  for (const auto& [name, x] : {std::pair("left rope", -kHalfWidth), {"right rope", kHalfWidth}}) {
    model = glue(model, hanging_rope(name, x, softening), bond).model;
  }
  model.name = "swing";
  const double push = values.at("push");
  for (PointId p : ids_of(model.points)) {
    const double below_bar = (kBar - model.geometry.points[p].y()) / (kBar - kSeatTop);
    model.points[p].velocity = {0.0, 0.0, push * below_bar};
  }
  Scene scene;
  scene.name = "swing";
  scene.seconds = 8.0;
  scene.air = Air{.wind = gusts(values.at("wind"))};
  scene.objects.push_back(std::move(model));
  scene.boxes.push_back({.name = "bar",
                         .half_extents = {0.5, 0.03, 0.03},
                         .centre = {0.0, kBar + 0.035, 0.0},
                         .colour = {0.4, 0.3, 0.2}});
  scene.camera = {{3.4, 1.5, 2.6}, {0.0, 1.15, 0.0}, 34.0};
  return scene;
}

}  // namespace

SceneEntry swing() {
  return {"swing",
          "a wooden seat on two ropes in gusting wind",
          {{"push", 1.5, "m/s", "speed of the seat at the start", -10.0, 10.0},
           {"wind", 12.0, "m/s", "of the gusts at their height", -40.0, 40.0},
           {"softening", 400.0, "", "S of wood and hemp: modulus / S, strain at break x sqrt S",
            1.0, 1e4}},
          build};
}

}  // namespace limber::demos
