#pragma once

#include <array>
#include <vector>

#include "core/model/surface_model.h"

namespace limber::demos {

// Per triangle and corner the unit normal to shade with: the mean, weighted by the angle at the
// corner, over the triangles around the point that look like part of the same smooth skin. These
// are of the same subobject, as little or as much exposed by breaking, and not bent away by more
// than the crease angle. So glazed ceramic looks round and a break looks sharp.
// A triangle without area gets zero vectors.
std::vector<std::array<Vec3, 3>> crease_normals(const SurfaceModel& surface, double crease_rad);

}  // namespace limber::demos
