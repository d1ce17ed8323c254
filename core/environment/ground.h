#pragma once

#include <limits>

#include "core/model/vec3.h"

namespace limber {

// A fixed plane that points rest on and rub against. (In a Bullet world the ground is a Bullet
// body; this one is for the simulator alone.)
struct Ground {
  Vec3 normal = Vec3::UnitY();  // unit, pointing out of the ground
  double height = 0.0;          // m: the surface is at normal . x = height

  // Penalty of each point below the surface, N/m and N s/m: F = k depth + c d(depth)/dt. Infinite:
  // a hard ground without restitution, a point sticks to it until the force on it points away.
  double stiffness = std::numeric_limits<double>::infinity();
  double damping = 0.0;
  // The end of a damped contact: may the force pull the point back until it has left (overlap law),
  // or does it end when it would turn adhesive (force law, the default)?
  bool adhesive = false;

  // Coulomb friction at each point: at rest it bears up to mu_s N, sliding it is slowed by mu_k N.
  double static_friction = 0.0;
  double kinetic_friction = 0.0;  // at most the static one
};

// Normal force of a penalty ground on one point, N: k depth + c depth_rate while depth > 0, and
// with the force law never below zero. depth > 0 below the surface (m), its rate m/s. Only for a
// finite stiffness.
// With zeta = c / (2 sqrt(k m)) a mass without weight is given back this share of its speed:
//   overlap law  exp(-pi zeta / sqrt(1 - zeta^2))                               half a period
//   force law    exp(-(pi - atan2(2 beta w, w^2 - beta^2)) beta / w), beta = c / (2 m),
//                w = sqrt(k/m - beta^2)      (Schwager and Poeschel, Granular Matter 9 (2007) 465)
double ground_force(const Ground& ground, double depth, double depth_rate);

// Throws InputError: normal not a unit vector, stiffness or damping negative, damping of a hard
// ground, kinetic above static friction, anything but the stiffness not finite.
void require_valid(const Ground& ground);

}  // namespace limber
