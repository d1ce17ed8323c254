#pragma once

#include <functional>
#include <string>

#include "core/model/geometric_model.h"
#include "core/modeller/hexahedral_cell.h"

namespace limber {

// Solids of hexahedral cells without crowded poles or axes: a middle block of half the width with
// layers of cells around it. The surface's points lie on the true surface, so volume and area are a
// little small, in proportion to the square of the cell size. All give one subobject called `name`
// and throw InputError for numbers that are senseless or would give too many points.

struct SolidSphere {
  Vec3 centre = Vec3::Zero();  // m
  double radius = 0.0;         // m
  int cells_across = 8;        // along a diameter, >= 4
  CellEdges edges = {};
};
GeometricModel solid_sphere(const SolidSphere& sphere, const std::string& name);

// Its axis is parallel to y; place() turns it.
struct SolidCylinder {
  Vec3 base = Vec3::Zero();  // m, centre of the lower end
  double radius = 0.0;       // m
  double height = 0.0;       // m
  int cells_across = 8;      // along a diameter, >= 4
  int cells_along = 0;       // 0: as many as make cells about as high as wide
  CellEdges edges = {};
};
GeometricModel solid_cylinder(const SolidCylinder& cylinder, const std::string& name);

// What a profile sweeps about the y axis. An end of radius 0 is closed by a cap of cells, another
// one is flat. Cells are as many across everywhere: a profile that is ten times as wide in one
// place as in another, other than near a closed end, has cells that differ as much, and a closed
// lens has cells as flat as itself.
struct SolidOfRevolution {
  std::function<double(double y)> radius;  // m, above 0 between the ends, 0 or above there
  double y_low = 0.0;                      // m
  double y_high = 0.0;                     // m
  Vec3 origin = Vec3::Zero();              // m, of the axis at y = 0
  int cells_across = 8;                    // along a diameter, >= 4
  int cells_along = 0;                     // rows between the caps; 0: about as high as wide
  CellEdges edges = {};
};
GeometricModel solid_of_revolution(const SolidOfRevolution& solid, const std::string& name);

}  // namespace limber
