// A mug from an equation: shape, material, handle, glue, file. docs/modelling.md explains it.

#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/model/errors.h"
#include "core/modeller/glue_material.h"
#include "core/modeller/material_report.h"
#include "core/modeller/material_table.h"
#include "core/modeller/ring_shell.h"
#include "core/modeller/rope.h"
#include "core/modeller/thin_material.h"
#include "core/operators/gluing_operator.h"
#include "core/storage/model_file.h"

namespace {

using limber::Vec3;
using std::numbers::pi;

limber::PhysicalModel mug() {
  limber::Material stoneware = limber::material_named("stoneware").material;
  stoneware.softening = 1000;  // modulus / 1000; the same impact speed breaks it

  // The wall: a cylinder of 8 cm, 9 cm high, 4 mm thick. u runs around it, v up.
  const limber::RingSurface wall{
      [](double u, double v) {
        return Vec3(0.04 * std::cos(2 * pi * u), 0.09 * v, -0.04 * std::sin(2 * pi * u));
      },
      [](double u, double) { return Vec3(std::cos(2 * pi * u), 0, -std::sin(2 * pi * u)); }};
  limber::GeometricModelBuilder builder;
  builder.begin_subobject("wall");
  limber::add_ring_shell(builder, wall, {.spacing = 0.008, .wall_thickness = 0.004});
  limber::PhysicalModel body = limber::with_material(builder.finish(), "mug", stoneware);

  // The handle: half a ring of twine, 2 mm before the wall, 12 segments.
  limber::Material twine = limber::material_named("hemp").material;
  twine.softening = stoneware.softening;
  const limber::Curve bow = [](double t) {
    return Vec3(0.042 + 0.025 * std::sin(pi * t), 0.02 + 0.05 * t, 0);
  };
  const limber::PhysicalModel handle = limber::with_rope_material(
      limber::rope(limber::points_along(bow, 12), "handle"), "handle", twine,
      limber::round_section(0.005));

  // Glue: as strong as stoneware on a square centimetre, wherever two points are within 6 mm.
  limber::GlueBond glue = limber::bond_like(stoneware, 1e-4, 0.002);
  glue.distance = 0.006;
  return limber::glue(body, handle, glue).model;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_mug FILE\n");
    return 2;
  }
  try {
    const limber::PhysicalModel model = mug();
    const limber::MaterialReport report = limber::material_report(model);
    std::printf("%.3f kg, %.0f substeps a tick, %.0f with the real modulus\n",
                limber::total_mass(model), report.substeps_per_tick,
                report.substeps_per_tick_unsoftened);
    for (const limber::Diagnostic& note : limber::modelling_notes(model, report)) {
      std::printf("note: %s\n", note.text().c_str());
    }
    limber::write_model(model, argv[1]);
  } catch (const limber::InputError& error) {
    std::fprintf(stderr, "make_mug: %s\n", error.what());
    return 2;
  }
  return 0;
}
