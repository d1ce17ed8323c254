#pragma once

#include <optional>

#include "core/model/physical_model.h"

namespace limber {

// element_frequency_bound() with elements of up to 6 x 6 x 6 cells of a grid, each proved by
// proved_frequency(): within 1 % of the highest frequency where element_frequency_bound() is 20 to
// 65 % above it. A regular lattice has a few kinds of such blocks. None where there is no grid
// (regular_grid.h), or so many kinds that solving them would take seconds.
std::optional<double> block_frequency_bound(const PhysicalModel& model);

}  // namespace limber
