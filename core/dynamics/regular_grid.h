#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/dynamics/grid_steps.h"
#include "core/model/physical_model.h"

namespace limber {

// Springs of one direction with equal constants. The thresholds are the least of them all.
struct SpringClass {
  double stiffness = 0.0;                 // N/m
  double damping = 0.0;                   // N s/m
  double break_threshold = kUnbreakable;  // m of stretch
  double crush_threshold = kUnbreakable;  // m of shortening
};

// Class numbers take four bits, and one stands for "no spring".
inline constexpr std::size_t kMostSpringClasses = 15;

// One spring seen from its first point: direction 2 d leads d steps on, 2 d + 1 back.
struct GridSpring {
  EdgeId edge;
  std::int32_t cell = 0;  // of the edge's first point
  std::uint8_t half = 0;  // 2 d, or 2 d + 1 where the edge's first point is the later one
  std::uint8_t spring_class = 0;
};

// A part of a model whose points lie on a grid, x fastest, and whose springs join neighbours: all
// that voxels and boxes are made of. A cell of the grid holds one point or none.
struct RegularGrid {
  std::array<std::int32_t, 3> size = {0, 0, 0};          // cells along each axis
  std::vector<std::int32_t> point;                       // shape (cells): the model's point, or -1
  std::array<double, kGridDirections> rest_length = {};  // m; 0: no spring in that direction
  std::array<std::vector<SpringClass>, kGridDirections> classes;
  std::vector<GridSpring> springs;

  std::int32_t cell_of(const GridStep& at) const {
    return at[0] + size[0] * (at[1] + size[1] * at[2]);
  }
};

// The grids in a model, by their topology: from a point with the most edges, along edges that are
// close to a step, as far as they lead; then from the points that are left. The shape may be turned
// and bent a little, but rest lengths are those of a regular lattice. What fits into no grid, and
// grids too small or too sparse to be worth it, are left out: every edge is in one grid at most.
std::vector<RegularGrid> regular_grids(const PhysicalModel& model);

}  // namespace limber
