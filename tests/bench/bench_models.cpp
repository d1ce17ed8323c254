#include "tests/bench/bench_models.h"

#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"

namespace limber::bench {

PhysicalModel brick(int points, double side_m, const Vec3& corner_m) {
  const Material clay = {.density = 2000.0,
                         .youngs_modulus = 1.5e10,
                         .strain_at_break = 3e-4,
                         .damping_ratio = 0.2,
                         .internal_damping = 30.0,
                         .friction = 0.6,
                         .softening = 1000.0};
  const int cells = points - 1;
  const Vec3 spacing = Vec3::Constant(side_m / cells);
  return with_material(box_lattice({cells, cells, cells}, spacing, corner_m, "brick"), "brick",
                       clay);
}

}  // namespace limber::bench
