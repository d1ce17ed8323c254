#pragma once

#include <span>
#include <vector>

#include "core/dynamics/lattice.h"

namespace limber {

// Connected pieces of the dynamic points. Labels count from 0 in the order of each piece's smallest
// point; a point without live springs is a piece of its own.
struct Components {
  std::vector<std::int32_t> label;  // shape (P), -1 for points that are not dynamic
  std::int32_t count = 0;
};

// Union-find over the unbroken active springs.
Components components(const Lattice& lattice);

// The points of each piece, ascending. Shape (count).
std::vector<std::vector<std::int32_t>> points_of(const Components& components);

}  // namespace limber
