#pragma once

#include "core/model/geometric_model.h"

namespace limber {

// Does the cell lie flat instead of enclosing a volume? Faces of a closed cell sum up to nothing,
// those of a flat one to its area. (The volume of a flat cell depends on where the origin is.)
bool is_sheet_cell(const GeometricModel& geometry, const Cell& cell);

}  // namespace limber
