#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/model/ids.h"
#include "core/model/vec3.h"

namespace limber {

// A hexahedral cell that a skin hangs on. Corner c is on the +x side for c & 1, +y for c & 2, +z
// for c & 4, of the lattice's own, right-handed axes. `grid` is where the cell is in that lattice:
// the place (x, y, z) of a cell is (x - 1, y, z) of its neighbour at grid + (1, 0, 0).
struct SkinCell {
  CellId cell;
  std::array<PointId, 8> corners;
  std::array<std::int32_t, 3> grid = {0, 0, 0};
};

// Moves with its host: at sum over corners c of w_c(place) x_c, the trilinear weights; 0..1 along
// each axis is inside the cell, what lies a little outside is extrapolated.
struct SkinVertex {
  std::int32_t host = 0;      // into Skin::cells
  Vec3 place = Vec3::Zero();  // without unit
};

// Is seen as long as its owner is valid. A corner whose own host was torn off moves with the owner.
struct SkinTriangle {
  std::array<std::int32_t, 3> corners = {0, 0,
                                         0};  // into Skin::vertices, anticlockwise from outside
  std::int32_t owner = 0;                     // into Skin::cells
};

// A vertex is at most this many cells away from its host: farther out, small deformations of a cell
// would become large ones of the skin.
inline constexpr double kMostSkinReach = 16.0;

// The surface that a lattice was made from: it deforms and tears with the cells, and pictures show
// it instead of their faces. It has no influence on the physics.
struct Skin {
  std::vector<SkinCell> cells;
  std::vector<SkinVertex> vertices;
  std::vector<SkinTriangle> triangles;
};

}  // namespace limber
