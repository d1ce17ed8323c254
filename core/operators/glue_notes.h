#pragma once

#include <span>
#include <vector>

#include "core/model/errors.h"
#include "core/model/physical_model.h"
#include "core/operators/point_pairs.h"

namespace limber {

// What the seam that these bonds make is like. "It is important that the number of points and
// distance between points be similar. The new bonds ... should be of similar lengths" (paper,
// section 5.3).
struct GlueSeam {
  struct Side {
    std::size_t points = 0;      // that have a bond
    std::size_t most_bonds = 0;  // at one of them
    PointId most_bonded;         // which; of equals the first
    double spacing_m = 0.0;      // median over them of their shortest own edge; 0: they have none
  };
  Side a, b;
  std::size_t bonds = 0;
  double shortest_m = 0.0, median_m = 0.0, longest_m = 0.0;  // lengths of the bonds
};
GlueSeam glue_seam(const PhysicalModel& a, const PhysicalModel& b,
                   std::span<const PointPair> bonds);

// Says, with the numbers, where spacings differ more than 1.5 times, where one side has at least
// twice the points of the other or a point has more than 9 bonds (straight across and to eight
// neighbours), where the longest bond is more than 3 times the shortest, and which of the second
// model's softening, friction, restitution and internal damping give way to the first's.
std::vector<Diagnostic> glue_notes(const PhysicalModel& a, const PhysicalModel& b,
                                   const GlueSeam& seam);

}  // namespace limber
