#pragma once

#include <array>

#include "core/model/geometric_model.h"

namespace limber {

// Which edges a cubic cell gets: 12 axial, 2 diagonals on each of 6 squares, 4 through the body.
struct CellEdges {
  bool axial = true;
  bool face_diagonals = true;
  bool body_diagonals = true;
  // One of the two on each square, which its two triangles share: from the corner with the lowest
  // coordinates to the opposite one. Of no consequence where there are both.
  bool one_face_diagonal = false;
};

// A box of cells[0] x cells[1] x cells[2] hexahedral cells of `spacing_m`, its lowest corner at
// `origin_m`; points in x-fastest order. One subobject called `name`.
// Throws InputError for fewer than one cell along an axis or a spacing that is not positive.
GeometricModel box_lattice(std::array<int, 3> cells, const Vec3& spacing_m, const Vec3& origin_m,
                           const std::string& name, CellEdges edges = {});

}  // namespace limber
