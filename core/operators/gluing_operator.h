#pragma once

#include <vector>

#include "core/model/errors.h"
#include "core/model/physical_model.h"

namespace limber {

// The attributes of the edges that glue makes.
struct GlueBond {
  double distance = 0.0;               // m: points this near or nearer are joined
  double stiffness = 0.0;              // N/m
  double damping = 0.0;                // N s/m
  double break_strain = kUnbreakable;  // threshold = strain x the bond's rest length
  double crush_strain = kUnbreakable;  // the same in compression
  bool one_to_one = false;             // bond each point at most once, nearest first: one_to_one()
};

struct GlueResult {
  PhysicalModel model;
  std::size_t bonds = 0;
  std::vector<Diagnostic> notes;  // where the seam will not behave as one piece: glue_notes()
};

// The gluing operator (paper, section 5.3): both models become one, with new edges between every
// pair of points, one of each, at most `bond.distance` apart (up to rounding: point_pairs.h). The
// models may have any dimensions. The subobjects of both are kept with all that belongs to them;
// the new edges form one more subobject, named "glue: A + B". Object attributes come from `a`;
// points keep mass and velocity, edges what is broken. Rest lengths are today's distances. Throws
// InputError when no pair is near enough or when two points coincide (a bond without direction).
GlueResult glue(const PhysicalModel& a, const PhysicalModel& b, const GlueBond& bond);

}  // namespace limber
