#include "core/dynamics/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analysis/tangent_stiffness.h"
#include "core/dynamics/block_bound.h"
#include "core/dynamics/element_bound.h"
#include "core/dynamics/proved_frequency.h"
#include "core/model/errors.h"

namespace limber {
namespace {

// 1/s^2: sums of a thousand of these are still finite.
constexpr double kLargestSquare = 1e300;

// Entries of the matrix's lower triangle: the factor has at least these, in whatever order. Known
// before the matrix, which takes a minute to assemble and analyse for a million points.
std::size_t least_factor_entries(const PhysicalModel& model) {
  const auto moves = [&](PointId p) { return !model.points[p].pinned; };
  std::size_t entries = 0;
  for (const PointAttributes& point : model.points) entries += point.pinned ? 0 : 6;
  for (std::size_t e = 0; e < model.edges.size(); ++e) {
    const auto [a, b] = model.geometry.edges[EdgeId(e)];
    if (!model.edges[EdgeId(e)].broken && moves(a) && moves(b)) entries += 9;
  }
  return entries;
}

FrequencyBound bound_by_elements(const PhysicalModel& model) {
  if (const auto by_blocks = block_frequency_bound(model)) return {*by_blocks, false};
  return {element_frequency_bound(model), false};
}

// Each number is finite, but stiffness over mass need not be.
void require_finite_frequencies(const PhysicalModel& model) {
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    const double lighter = std::min(model.points[a].mass, model.points[b].mass);
    if (model.edges[e].stiffness / lighter < kLargestSquare) continue;
    throw InputError({model.name + ": edge " + std::to_string(e.index()),
                      "its stiffness over the mass of its lighter point is beyond all numbers",
                      "check the units of stiffness, N/m, and mass, kg"});
  }
}

bool has_springs(const PhysicalModel& model) {
  return std::any_of(model.edges.begin(), model.edges.end(), [](const EdgeAttributes& edge) {
    return !edge.broken && edge.stiffness > 0.0;
  });
}

}  // namespace

FrequencyBound highest_frequency(const PhysicalModel& model, std::size_t most_entries) {
  if (!has_springs(model)) return {0.0, true};
  require_finite_frequencies(model);
  if (least_factor_entries(model) > most_entries) return bound_by_elements(model);
  const auto proved = proved_frequency(scaled_stiffness_bound(model), most_entries);
  return proved ? FrequencyBound{*proved, true} : bound_by_elements(model);
}

// Springs shorter than half their rest length count as stiff in all directions.
FrequencyBound large_strain_bound(const PhysicalModel& model) {
  double shrink = 1.0;
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    const double length = (model.geometry.points[b] - model.geometry.points[a]).norm();
    if (length > 0.0) shrink = std::min(shrink, model.edges[e].rest_length / length);
  }
  PhysicalModel folded = model;
  for (Vec3& x : folded.geometry.points) x *= 0.25 * shrink;
  return highest_frequency(folded);
}

double stable_step(double omega_rad_s, double damping_ratio) {
  if (omega_rad_s == 0.0) return std::numeric_limits<double>::infinity();
  // The closed form without its cancellation, which leaves nothing from a ratio of 1e8 on.
  return 2.0 / omega_rad_s / (std::hypot(1.0, damping_ratio) + damping_ratio);
}

}  // namespace limber
