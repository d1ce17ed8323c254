#pragma once

#include <map>
#include <string>

#include "core/model/physical_model.h"
#include "core/model/surface_model.h"

namespace limber::test {

// Counts of a (broken) model, keyed by the column names of tests/data/breaking_topology.csv without
// their "initial_" or "after_".
std::map<std::string, int> topology_counts(const PhysicalModel& model);

// Directed edges of the triangles that their reverses do not match in number; 0 for a closed and
// consistently oriented surface.
int unmatched_sides(const SurfaceModel& surface);

Vec3 momentum(const PhysicalModel& model);          // kg m/s
Vec3 angular_momentum(const PhysicalModel& model);  // about the origin, kg m^2/s

// By the divergence theorem, m^3.
double enclosed_volume(const SurfaceModel& surface);

}  // namespace limber::test
