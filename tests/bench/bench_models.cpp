#include "tests/bench/bench_models.h"

#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"

namespace limber::bench {

PhysicalModel brick(int points, double side_m, const Vec3& corner_m) {
  Material clay;
  clay.density = 2000.0;
  clay.youngs_modulus = 1.5e10;
  clay.strain_at_break = 3e-4;
  clay.damping_ratio = 0.2;
  clay.internal_damping = 30.0;
  clay.friction = 0.6;
  clay.softening = 1000.0;
  const int cells = points - 1;
  const Vec3 spacing = Vec3::Constant(side_m / cells);
  return with_material(box_lattice({cells, cells, cells}, spacing, corner_m, "brick"), "brick",
                       clay);
}

}  // namespace limber::bench
