#pragma once

#include <functional>
#include <string>

#include "core/model/geometric_model.h"

namespace limber {

// A surface swept by closed rings: position(u, v) with u in [0, 1) around and v in [0, 1] along,
// m; `normal` is the outward unit normal.
struct RingSurface {
  std::function<Vec3(double u, double v)> position;
  std::function<Vec3(double u, double v)> normal;
};

struct RingShellOptions {
  double spacing = 0.0;         // m, wanted distance of neighbouring points
  double wall_thickness = 0.0;  // m, laid on the inner side
  double v_begin = 0.0;         // the part of the surface that is used
  double v_end = 1.0;
};

// A shell of triangular-prism cells: rings of points an equal arc length apart, each with as many
// points as its circumference needs, neighbouring rings zipped by triangles, and an inner layer one
// wall thickness down the normal. A ring that has shrunk to a point (pole) becomes one point.
// Adds the cells to the builder's current subobject.
void add_ring_shell(GeometricModelBuilder& builder, const RingSurface& surface,
                    const RingShellOptions& options);

}  // namespace limber
