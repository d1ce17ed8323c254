#pragma once

#include <cstdint>
#include <vector>

#include "core/dynamics/components.h"

namespace limber::test {

// The smallest point of every point's piece, -1 for points without one: the same for two labellings
// exactly if they are the same partition.
std::vector<std::int32_t> smallest_in_piece(const Components& components);

// Points with each label, counted one by one.
std::vector<std::int32_t> sizes_of(const Components& components);

}  // namespace limber::test
