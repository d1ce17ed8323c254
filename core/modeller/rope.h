#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/model/geometric_model.h"

namespace limber {

// A curve in space: position (m) at t from 0 to 1.
using Curve = std::function<Vec3(double t)>;

// The curve that runs straight from each of these points to the next, at a steady pace. Throws
// InputError for fewer than two points, for equal neighbours and for what is not finite.
Curve polyline(std::vector<Vec3> points_m);

// Length along the curve, m, by its chords; their error shrinks with the square of their number.
double curve_length(const Curve& curve);

// segments + 1 points from one end of the curve to the other, equal lengths of curve apart. Throws
// InputError for fewer than one segment or too many, and for a curve without length.
std::vector<Vec3> points_along(const Curve& curve, int segments);

// How many segments of about this length (m) a curve has; at least one.
int segments_of(const Curve& curve, double spacing_m);

enum class RopeEnds {
  kOpen,
  kJoined,  // an edge from the last point to the first: a ring
};

// Points joined one after the other by edges; no faces, no cells. One subobject called `name`.
// Throws InputError for too few points (2, for a ring 3), equal neighbours and positions that are
// not finite.
GeometricModel rope(std::span<const Vec3> points_m, const std::string& name,
                    RopeEnds ends = RopeEnds::kOpen);

}  // namespace limber
