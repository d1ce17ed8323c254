#pragma once

#include <functional>

#include "core/model/geometric_model.h"
#include "core/modeller/hexahedral_cell.h"

namespace limber {

// Internal to the modellers of round solids. A box of cells in the middle and layers of cells
// around it: an O-grid. It maps to a ball or a cylinder with neither a pole nor an axis that many
// cells meet at.
struct OGrid {
  int across = 1;  // cells of the middle along x and z
  int along = 1;   // along y
  int layers = 1;  // around the sides, and over the ends that have a cap
  bool low_cap = true;
  bool high_cap = true;
};

// Where a point is: on the grid of the middle, -1 to 1 along each axis, and from 0, there, to 1, on
// the outer surface, through the layers.
struct OGridPlace {
  Vec3 middle;
  double outward;
};

// About this many points, in double.
double point_count(const OGrid& grid);

// Adds points where `position` (m) says and the hexahedral cells to the builder's current
// subobject. `position` must keep the orientation.
void add_o_grid(GeometricModelBuilder& builder, const OGrid& grid,
                const std::function<Vec3(const OGridPlace&)>& position, const CellEdges& edges);

// The standard forms, of radius 1 about the origin: an O-grid with both caps, and one without,
// whose axis is y from -1 to 1. The middle is a bulged cube, or square, of 0.4 of the width.
Vec3 in_ball(const OGridPlace& place);
Vec3 in_cylinder(const OGridPlace& place);

}  // namespace limber
