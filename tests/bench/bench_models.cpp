#include "tests/bench/bench_models.h"

#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"

namespace limber::bench {

namespace {

PhysicalModel of_clay(GeometricModel shape) {
  const Material clay = {.density = 2000.0,
                         .youngs_modulus = 1.5e10,
                         .strain_at_break = 3e-4,
                         .damping_ratio = 0.2,
                         .internal_damping = 30.0,
                         .friction = 0.6,
                         .softening = 1000.0};
  return with_material(std::move(shape), "brick", clay);
}

GeometricModel cube(int points, double side_m, const Vec3& corner_m) {
  const int cells = points - 1;
  return box_lattice({cells, cells, cells}, Vec3::Constant(side_m / cells), corner_m, "brick");
}

}  // namespace

PhysicalModel brick(int points, double side_m, const Vec3& corner_m) {
  return of_clay(cube(points, side_m, corner_m));
}

PhysicalModel tapered_brick(int points, double side_m, const Vec3& corner_m) {
  GeometricModel shape = cube(points, side_m, corner_m);
  const Vec3 middle = corner_m + Vec3::Constant(0.5 * side_m);
  for (Vec3& x : shape.points) {
    const double width = 1.0 - (x.y() - corner_m.y()) / (3.0 * side_m);
    x.x() = middle.x() + width * (x.x() - middle.x());
    x.z() = middle.z() + width * (x.z() - middle.z());
  }
  return of_clay(std::move(shape));
}

}  // namespace limber::bench
