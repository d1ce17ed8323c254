#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"
#include "demos/scenes/scenes.h"

namespace limber::demos {
namespace {

constexpr double kSide = 0.2;  // m

// Pulls the cube long and thin at a rate that makes it wobble in its lowest mode: v = A r with a
// traceless A (no volume change), so that neither P nor L changes.
void set_wobbling(PhysicalModel& model, const Vec3& centre, double rate_per_s) {
  for (PointId p : ids_of(model.points)) {
    const Vec3 r = model.geometry.points[p] - centre;
    model.points[p].velocity += rate_per_s * Vec3(r.x(), -2.0 * r.y(), r.z());
  }
}

PhysicalModel cube(const std::string& name, int cells, const Material& material, const Vec3& centre,
                   const Vec3& colour) {
  const double spacing = kSide / cells;
  const Vec3 corner = centre - Vec3::Constant(0.5 * kSide);
  PhysicalModel model = with_material(
      box_lattice({cells, cells, cells}, Vec3::Constant(spacing), corner, name), name, material);
  model.parts[0].surface.colour = colour;
  return model;
}

Material jelly() {
  Material m;
  m.density = 1000.0;
  m.youngs_modulus = 1.5e5;  // firm gelatine
  m.damping_ratio = 0.1;
  m.internal_damping = 1.0;
  m.friction = 0.6;
  return m;
}

Material brick(double softening) {
  Material m;
  m.density = 2000.0;
  m.youngs_modulus = 1.5e10;  // fired clay
  m.strain_at_break = 3e-4;
  m.damping_ratio = 0.2;
  m.internal_damping = 30.0;
  m.friction = 0.6;
  m.softening = softening;
  return m;
}

Scene build(const ParameterValues& values) {
  Scene scene;
  scene.name = "jelly_and_brick";
  scene.seconds = 3.0;
  const double height = values.at("height");
  const Vec3 jelly_centre(-0.2, height + 0.5 * kSide, 0.0);
  const Vec3 brick_centre(0.2, height + 0.5 * kSide, 0.0);
  scene.objects.push_back(cube("jelly", 6, jelly(), jelly_centre, {0.75, 0.15, 0.2}));
  scene.objects.push_back(
      cube("brick", 6, brick(values.at("softening")), brick_centre, {0.6, 0.3, 0.2}));
  set_wobbling(scene.objects[0], jelly_centre, values.at("wobble"));
  scene.camera = {{0.5, 0.75, 1.9}, {0.0, 0.33, 0.0}, 30.0};
  return scene;
}

}  // namespace

SceneEntry jelly_and_brick() {
  return {"jelly_and_brick",
          "a soft cube and a stiff brick dropped side by side, the cube set wobbling",
          {{"height", 0.5, "m", "of the lowest points above the floor", 0.0, 100.0},
           {"wobble", 3.0, "1/s", "rate at which the jelly is being stretched at the start", -10.0,
            10.0},
           {"softening", 1000.0, "", "S of the brick: modulus / S, strain at break x sqrt S", 1.0,
            1e6}},
          build};
}

}  // namespace limber::demos
