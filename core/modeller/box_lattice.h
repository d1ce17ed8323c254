#pragma once

#include <array>
#include <string>

#include "core/modeller/hexahedral_cell.h"

namespace limber {

// A box of cells[0] x cells[1] x cells[2] hexahedral cells of `spacing_m`, its lowest corner at
// `origin_m`; points in x-fastest order. One subobject called `name`.
// Throws InputError for fewer than one cell along an axis or a spacing that is not positive.
GeometricModel box_lattice(std::array<int, 3> cells, const Vec3& spacing_m, const Vec3& origin_m,
                           const std::string& name, CellEdges edges = {});

}  // namespace limber
