#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/dynamics/grid_steps.h"

namespace limber {

// Cells that are computed together, whatever the width of the machine's vectors.
inline constexpr int kStencilBlock = 16;
inline constexpr int kStencilClasses = 16;  // 0: no spring

// Constants of all classes of one direction, in the units of the kernel.
struct alignas(64) StencilConstants {
  std::array<float, kStencilClasses> stiffness = {};  // N/m
  std::array<float, kStencilClasses> damping = {};    // N s/m per quantum
  std::array<float, kStencilClasses> longest = {};    // bounds of L^2 - L0^2, quanta^2
  std::array<float, kStencilClasses> shortest = {};
  float rest_length = 0.0f;  // quanta
  std::int32_t offset = 0;   // from a cell to its neighbour
};

// What the kernel reads and writes, cell by cell. Positions are whole numbers of quanta modulo
// 2^32: differences of neighbours are exact wherever in the world they are.
struct StencilView {
  std::array<const std::int32_t*, 3> position;  // quanta
  std::array<const float*, 3> velocity;         // m/s
  std::array<const std::uint32_t*, 4> classes;  // 26 x 4 bits: cell's springs, half 2 d at 8 d
  const StencilConstants* constants;            // shape (13)
  float quantum;                                // m
  bool crush;                                   // are there bounds of shortening?
  std::array<float*, 3> force;                  // N
};

// Sums the forces of the springs of each cell of the blocks (first cells given). Every spring is
// computed at both ends, so that no two blocks write the same place, with the same bits: each has
// its exact reaction, but for the rounding of the sums. Bit i of overstretched[b]: a spring of cell
// i of block b may have passed a threshold.
void sum_stencil_forces(const StencilView& view, std::span<const std::int32_t> blocks,
                        std::span<std::uint16_t> overstretched);

}  // namespace limber
