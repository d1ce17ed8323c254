#pragma once

#include <array>

namespace limber {

// The 13 directions from a grid cell to the neighbours that come after it; their reverses lead to
// the other 13 of its 26 neighbours.
using GridStep = std::array<int, 3>;  // -1, 0 or 1 along each axis
inline constexpr int kGridDirections = 13;
inline constexpr std::array<GridStep, kGridDirections> kGridSteps = {{{1, 0, 0},
                                                                      {-1, 1, 0},
                                                                      {0, 1, 0},
                                                                      {1, 1, 0},
                                                                      {-1, -1, 1},
                                                                      {0, -1, 1},
                                                                      {1, -1, 1},
                                                                      {-1, 0, 1},
                                                                      {0, 0, 1},
                                                                      {1, 0, 1},
                                                                      {-1, 1, 1},
                                                                      {0, 1, 1},
                                                                      {1, 1, 1}}};

}  // namespace limber
