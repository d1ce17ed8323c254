#pragma once

#include "bullet_bridge/shapes/contact_shape.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// Where a face lies deepest in a convex part.
struct FacePenetration {
  Vec3 weights;          // of the face's corners: barycentric coordinates of that place
  double depth = 0.0;    // m, negative outside; an upper bound when that is <= 0
  double bound = 0.0;    // m: no place of the face is deeper
  double corners = 0.0;  // m: depth of the deepest corner
  double settled = 0.0;  // m: however the corners move by less, the deepest place is one of them
};

// Of a triangle, `corners` as columns in the frame of the whole shape, m; to `tolerance_m`. Points
// alone do not do: a rod or a box's corner thinner than a lattice's cells passes between them.
//
// Depth is concave over a convex part, so that each place where it is known bounds it by a plane,
// and the bounds' highest place is where to look next (the cutting planes of Kelley, "The
// Cutting-Plane Method for Solving Convex Programs", 1960). For boxes and hulls, whose depth is
// made of planes, this ends exactly; a face that does not reach the part is mostly known from its
// three corners. Newton's and gradient methods stop at the creases between a box's sides.
FacePenetration deepest_place(const ContactPart& part, const Mat3& corners, double tolerance_m);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
