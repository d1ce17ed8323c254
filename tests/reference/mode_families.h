#pragma once

#include <vector>

#include "core/model/physical_model.h"

namespace limber::reference {

// The modes of a straight chain of n free points, rad/s, ascending, n each. Across the chain every
// frequency comes twice and is listed once.
struct ModeFamilies {
  std::vector<double> along, across;
  std::vector<double> lowest_shape_across;  // of each free point; 1 for the last one
};

ModeFamilies mode_families(const PhysicalModel& chain, const Vec3& direction);

}  // namespace limber::reference
