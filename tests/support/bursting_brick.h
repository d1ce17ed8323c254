#pragma once

#include <cmath>

#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"

namespace limber {

// A brick that is about to burst into along^3 cubes of one cell each, all of them in its first
// substeps: the cubes fly away from the middle, what joins them hardly bears anything, and they
// themselves never break. Softened clay.
inline PhysicalModel bursting_brick(int along, const Vec3& middle) {
  constexpr double kSpacing = 0.05;   // m
  constexpr double kSpreading = 2.0;  // 1/s: speed by distance from the middle
  constexpr double kWeakest = 1e-4;   // strain that joints bear
  const int points = 2 * along, cells = points - 1;
  const Material clay = {.density = 2000.0,
                         .youngs_modulus = 1.5e7,
                         .damping_ratio = 0.2,
                         .internal_damping = 30.0,
                         .friction = 0.6};
  PhysicalModel model =
      with_material(box_lattice({cells, cells, cells}, Vec3::Constant(kSpacing),
                                middle - Vec3::Constant(0.5 * kSpacing * cells), "bursting brick"),
                    "bursting brick", clay);
  const auto cube_of = [&](PointId p) -> Vec3 {  // counted along the axes
    const int i = p.value;
    return Vec3(i % points / 2, i / points % points / 2, i / (points * points) / 2);
  };
  for (PointId p : ids_of(model.points)) {
    const Vec3 place = 2.0 * kSpacing * (cube_of(p) - Vec3::Constant(0.5 * (along - 1)));
    model.points[p].velocity = kSpreading * place;
  }
  for (EdgeId e : ids_of(model.edges)) {
    const Edge& edge = model.geometry.edges[e];
    if (cube_of(edge.a) == cube_of(edge.b)) continue;
    model.edges[e].break_threshold = kWeakest * model.edges[e].rest_length;
  }
  return model;
}

}  // namespace limber
