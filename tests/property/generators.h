#pragma once

#include <rapidcheck/gtest.h>

#include <optional>
#include <vector>

#include "core/model/errors.h"
#include "core/model/physical_model.h"
#include "core/operators/gluing_operator.h"
#include "tests/support/blocks.h"

// Random values for properties; to be called from inside of one.

namespace limber::test {

inline double uniform(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) * 1e-6;
}

inline bool coin() { return *rc::gen::arbitrary<bool>(); }

inline Vec3 random_vector(double size) {
  const double x = uniform(-size, size), y = uniform(-size, size), z = uniform(-size, size);
  return {x, y, z};
}

inline BlockShape random_shape(int most_cells) {
  BlockShape shape;
  for (int& n : shape.cells) n = *rc::gen::inRange(1, most_cells + 1);
  shape.edges.both_diagonals = coin();
  shape.edges.body_diagonals = coin();
  return shape;
}

// Any number of them, also none, and the same more than once. Empty for a model without edges.
inline std::vector<std::int32_t> random_edges(const PhysicalModel& m) {
  if (m.edges.empty()) return {};
  return *rc::gen::container<std::vector<std::int32_t>>(
      rc::gen::inRange(0, static_cast<int>(m.edges.size())));
}

inline std::vector<EdgeId> ids(const std::vector<std::int32_t>& indices) {
  std::vector<EdgeId> edges;
  for (std::int32_t i : indices) edges.push_back(EdgeId(std::size_t(i)));
  return edges;
}

// Nothing where no points are near enough, or some coincide.
inline std::optional<GlueResult> try_to_glue(const PhysicalModel& a, const PhysicalModel& b,
                                             const GlueBond& bond) {
  try {
    return glue(a, b, bond);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace limber::test
