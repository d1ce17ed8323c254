#pragma once

#include <functional>
#include <string>

#include "core/model/geometric_model.h"

namespace limber {

// A surface in space: position (m) at u and v from 0 to 1. Its outer side is that of
// dS/du x dS/dv.
using ParametricSurface = std::function<Vec3(double u, double v)>;

enum class SheetCells {
  // Rows of points, every other one shifted by half a step: equilateral triangles where a row is
  // sqrt(3)/2 of a step high. The springs of these make an isotropic sheet.
  kTriangles,
  // A square grid, each square a cell with both its diagonals.
  kSquares,
};

struct SheetGrid {
  int cells_u = 1;  // steps along u
  int cells_v = 1;  // rows along v
  SheetCells cells = SheetCells::kTriangles;
  bool joined_u = false;  // the surface closes: u = 1 is u = 0
};

// The grid whose cells are as equilateral as the mean lengths of the surface along u and v allow,
// with sides of about `spacing_m`.
SheetGrid grid_for(const ParametricSurface& surface, double spacing_m,
                   SheetCells cells = SheetCells::kTriangles);

// A sheet of 2-D cells over an even grid in u and v; faces look to the outer side, and both sides
// are drawn. One subobject called `name`. Throws InputError for too few or too many cells, for
// positions that are not finite, and where neighbouring points meet (a pole: end the surface before
// it).
GeometricModel sheet(const ParametricSurface& surface, const SheetGrid& grid,
                     const std::string& name);

// The same with a wall: prisms (of triangles) or hexahedra (of squares with all their diagonals),
// one layer of cells, the surface their outer side and `wall_thickness_m` laid on the inner one.
// For closed rings with poles see ring_shell.h. Throws InputError as above, for a thickness that is
// not positive, where the surface has no normal, and where the wall is thicker than the surface's
// curvature allows.
GeometricModel shell_patch(const ParametricSurface& surface, const SheetGrid& grid,
                           double wall_thickness_m, const std::string& name);

}  // namespace limber
