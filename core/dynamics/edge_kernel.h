#pragma once

#include <cstdint>

namespace limber {

// Motion of a point as the kernels read it: position in quanta modulo 2^32 (see stencil_kernel.h),
// velocity in m/s. The fourth numbers are zero and fill the vectors.
struct alignas(32) PackedMotion {
  std::int32_t position[4];
  float velocity[4];
};

struct alignas(16) PackedForce {
  float value[4];  // N / quantum
};

// Springs between any two points, in columns.
struct EdgeColumns {
  const std::int32_t* a;
  const std::int32_t* b;
  const float* stiffness;    // N/m
  const float* damping;      // N s/m per quantum
  const float* rest_length;  // quanta
  const float* longest;      // bounds of L^2 - L0^2, quanta^2
  const float* shortest;
};

// Springs that are computed together.
inline constexpr std::int32_t kEdgeBatch = 64;

// Forces of the springs [first, first + kEdgeBatch) on their first points: four numbers each, the
// last of them zero, N / quantum. Bit i of the answer: spring first + i may have passed a
// threshold.
std::uint64_t pull_edges(const EdgeColumns& edges, std::int32_t first, const PackedMotion* motion,
                         float* pulls);

// Adds the pulls of a batch to the forces on both ends, in the order of the springs.
void scatter_pulls(const EdgeColumns& edges, std::int32_t first, const float* pulls,
                   PackedForce* force);

}  // namespace limber
