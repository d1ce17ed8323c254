#pragma once

#include <array>

#include "core/model/geometric_model.h"

namespace limber {

// Adds the prism between a triangle of outer points, anticlockwise from outside, and its image of
// inner points below: 15 edges (9 sides, both diagonals of the three squares) and 8 triangles.
CellId add_prism(GeometricModelBuilder& builder, const std::array<PointId, 3>& outer,
                 const std::array<PointId, 3>& inner);

}  // namespace limber
