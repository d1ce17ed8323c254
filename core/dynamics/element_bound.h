#pragma once

#include "core/model/physical_model.h"

namespace limber {

// Upper bound on the highest angular frequency, rad/s, without solving for the whole: if K = sum
// K_c and M = sum M_c over elements, no eigenvalue of the whole exceeds the largest of any element
// (Fried, Journal of Applied Mechanics 39, 1972). Elements are the cells, and each edge without a
// cell; edges are shared equally, the mass of a point in proportion to the stiffness around it.
double element_frequency_bound(const PhysicalModel& model);

}  // namespace limber
