#pragma once

#include "core/model/physical_model.h"

namespace limber {

struct BendingSprings {
  double youngs_modulus = 0.0;  // Pa, the effective one of the sheet's material
  double thickness = 0.0;       // m
  // Break and crush strain of the springs, of the chords' lengths.
  double strain_at_break = kUnbreakable;
  double strain_at_crush = kUnbreakable;
  // The most that a bending spring may add to the sheet's stiffness against stretch, as a share.
  double most_added_stretch = 0.1;
};

// Joins second neighbours of a curved sheet, across the point between them, by springs under the
// arch: a bent sheet keeps its shape. Where edges run on from a point by the straightest way (the
// ends of a pair within 30 degrees of a line) their far ends are joined.
//
// Where the point between rises s above the chord, the chord changes by s for each radian of bend
// at that point, and a spring k bends like a beam of B = k h s^2 (N m^2), h the length of an edge.
// On an arc of curvature K, s = h^2 K / 2. All lines of edges through a point together are fitted
// to the isotropic plate E t^3 / 12 (Poisson ratio 1/3), as the edges of a cell are to the sheet. A
// thin curved strip gets E I / (1 - nu^2) = 9/8 E I, I = w t^3 / 12, the plate's, within a percent
// in squares and in equilateral triangles whose rows run along the direction that is not bent.
// Triangles whose rows run along the arc cannot fold across it: up to half too stiff while they are
// coarse.
//
// What this is not:
// - A flat sheet, or a straight direction of a curved one, has no bending stiffness to first order:
//   s is 0. There k is at its limit: a chord adds 4 k h to the line's stiffness against stretch, at
//   most most_added_stretch of it. It is reached where s is below t / sqrt(3 most_added_stretch),
//   1.8 t for 0.1. What is flatter bends more easily than the material and only resembles it.
// - Bent through flat to the other side, the arch snaps and keeps that shape too.
// - Where the sheet is folded flat upon itself, across the fold, there are none.
// The springs belong to no cell: they break by their own strain only.
//
// Returns how many were added. Throws InputError for values out of range, and for a model of more
// than one subobject (add them before gluing). Call set_stiffness_proportional_damping() afterwards
// where damping is to be proportional to stiffness: the springs have none.
int add_bending_springs(PhysicalModel& sheet, const BendingSprings& springs);

// N/m: B / (h s^2), the spring under a line of edges of the bending stiffness B, N m^2.
double bending_spring_stiffness(double bending_stiffness_N_m2, double edge_length_m, double rise_m);

}  // namespace limber
