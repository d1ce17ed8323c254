#pragma once

#include <span>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/dynamics/lattice.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// An impulse and its moment about the centre of mass of what gets it.
struct Impulse {
  Vec3 linear = Vec3::Zero();   // N s
  Vec3 angular = Vec3::Zero();  // N m s

  bool is_zero() const { return linear.isZero(0.0) && angular.isZero(0.0); }
};

// The changes of velocity that make the points' P and L grow by the impulse as those of a rigid
// body do; nothing is strained. None about a line that the points lie on.
struct RigidChange {
  Vec3 centre, velocity, angular_velocity;  // m, m/s, rad/s

  Vec3 at(const Vec3& place) const { return velocity + angular_velocity.cross(place - centre); }
};
RigidChange rigid_change(const Lattice& lattice, std::span<const std::int32_t> points,
                         const Impulse& impulse);

// Gives it to the velocities of all points that no pin holds.
void push_rigidly(Lattice& lattice, std::span<const std::int32_t> points, const Impulse& impulse);

// The same, and moves them as far as a body moves by that in a tick, s, and by `shift`, m.
void move_rigidly(Lattice& lattice, std::span<const std::int32_t> points, const Impulse& impulse,
                  double tick, const Vec3& shift);

// A force on a point throughout a tick.
struct PointLoad {
  std::int32_t point;
  Vec3 force;  // N
};

// The points that bear what acts on the piece at a place: the nearest, as many as a cell has.
std::vector<std::int32_t> points_around(const Lattice& lattice,
                                        std::span<const std::int32_t> points, const Vec3& place);

// Forces that give the points the impulse (about their own centre of mass) in a tick, s: those that
// move them rigidly.
std::vector<PointLoad> spread(const Lattice& lattice, std::span<const std::int32_t> points,
                              const Impulse& impulse, double tick);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
