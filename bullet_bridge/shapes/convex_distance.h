#pragma once

#include "bullet_bridge/shapes/contact_part.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// Closed forms, each in the frame of the shape. Depth is the exact distance to the surface,
// negative outside; the normal is minus its gradient (where there is none, on an axis say, one of
// those near).

// Centred at the origin.
Penetration box_penetration(const Vec3& half_extents, const Vec3& point);

Penetration sphere_penetration(double radius, const Vec3& point);

// Axis y: half_height to the centres of the caps.
Penetration capsule_penetration(double radius, double half_height, const Vec3& point);

// Axis y; the cylinder of these sizes and everything within `margin` of it.
Penetration cylinder_penetration(double radius, double half_height, double margin,
                                 const Vec3& point);

// Axis y: base at -half_height, tip at +half_height; and everything within `margin` of it.
Penetration cone_penetration(double radius, double half_height, double margin, const Vec3& point);

// Of any convex part of a shape but a plane: the point in the part's frame.
Penetration convex_penetration(const ContactPart& part, const Vec3& point);

// Where a way first enters a convex part.
struct WayIn {
  bool enters = false;
  double share = 0.0;  // of the way from a to b
  Vec3 normal = Vec3::Zero();
};

// a and b in the part's frame; a way that starts inside enters at once, through the nearest side.
// Newton's method on the distance along the way: it is convex, so that steps from outside never
// pass the surface and a distance that has stopped falling never will again.
WayIn way_into(const ContactPart& part, const Vec3& a, const Vec3& b);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
