#pragma once

#include <vector>

#include "core/model/geometric_model.h"

namespace limber {

// One cell as the formulas want it. One object serves all cells of a model, one after the other: a
// million cells would spend their time on allocations otherwise.
struct CellShape {
  std::vector<Vec3> edges;      // m, along each edge from its point a to b
  std::vector<PointId> points;  // at the ends of its edges, ascending

  // Replaces what was there before.
  void read(const GeometricModel& geometry, const Cell& cell);
};

}  // namespace limber
