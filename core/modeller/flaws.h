#pragma once

#include <cstdint>
#include <span>

#include "core/model/physical_model.h"

namespace limber {

// Brittle things break in tension along flaws: thresholds scatter, and weak seams run through.
struct Flaws {
  double scatter = 0.0;  // standard deviation of the thresholds, relative; clipped at 3 sigma
  int seams = 0;         // number of Voronoi sites; an edge between two regions lies on a seam
  double seam_strength = 1.0;  // factor on the thresholds of seam edges
  std::uint64_t seed = 1;
};

// The region of every point: the index of the nearest of `sites` sites, which are points of the
// model spread well over it. All zero without sites.
IdVector<PointId, std::int32_t> voronoi_regions(const GeometricModel& model, int sites,
                                                std::uint64_t seed);

// Multiplies the break thresholds; the same seed gives the same flaws on every machine.
void add_flaws(PhysicalModel& model, const Flaws& flaws);

}  // namespace limber
