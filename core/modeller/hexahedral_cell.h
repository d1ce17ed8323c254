#pragma once

#include <array>
#include <vector>

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

// A corner of a hexahedral cell is a number of three bits: 1 is +x, 2 is +y, 4 is +z.
inline constexpr int kHexahedronCorners = 8;
using HexahedronCorners = std::array<PointId, kHexahedronCorners>;

// The pairs of corners that these edges join, in ascending order.
std::vector<std::array<int, 2>> corner_pairs(const CellEdges& edges);

// Adds the cell with these corners: an edge for every pair, 12 triangles looking outwards.
CellId add_hexahedron(GeometricModelBuilder& builder, const HexahedronCorners& corners,
                      const std::vector<std::array<int, 2>>& pairs);

}  // namespace limber
