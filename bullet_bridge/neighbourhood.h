#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/dynamics/lattice.h"

class btCollisionObject;
class btCollisionWorld;
class btRigidBody;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

class ShapeCache;

// A body that points may reach, and the box in the world, m, in which they may meet it.
struct NearBody {
  const btCollisionObject* object;
  Vec3 low, high;
};

// The kinematic bodies and the links of multi-bodies that move, with the boxes that they may be in
// within dt. Bullet's own boxes of them are those of the moment; those of what impulses move
// include their way in the tick.
std::vector<NearBody> sweeping_bodies(const btCollisionWorld& world, double dt);

// What has a bounding box of Bullet's that reaches into this one (m), in no order to rely on.
// Without what has no contact response and flexible pieces.
std::vector<const btCollisionObject*> bodies_in(btCollisionWorld& world, const Vec3& low,
                                                const Vec3& high);

// Rigid bodies, plain collision objects and links of multi-bodies that respond to contact, but
// those that stand for a lattice.
bool is_met(const btCollisionObject& object);

// Do the game's groups, masks and own filter let the two meet?
bool may_meet(btCollisionWorld& world, const btCollisionObject& a, const btCollisionObject& b);

// The bodies that the points may reach within dt, those that sweep through the world among them, in
// the order in which the world holds them. Bodies without contact response are left out.
std::vector<NearBody> bodies_within_reach(btCollisionWorld& world,
                                          std::span<const NearBody> sweeping,
                                          const Lattice& lattice,
                                          std::span<const std::int32_t> points, double dt);

// In the order of the world, each body once, with a box around all of its boxes.
std::vector<NearBody> merged(std::vector<NearBody> near);

// The largest speed at which a point of one piece and a point of the other, near enough to meet
// within dt, approach; 0 when none can meet. Of pieces with many points that near each other, a
// sample of a few hundred is looked at.
double closing_speed(const Lattice& lattice, std::span<const std::int32_t> one,
                     std::span<const std::int32_t> other, double dt);

// The largest speed at which a point of the rigid piece closes in on the other body, m/s, of those
// that come into it or within `near`, m, of it in this tick; none where none does. Both move on as
// they move now; so many looks are taken that no point is overlooked between two of them. `local`:
// the piece's points in the frame of `body`.
std::optional<double> reaching_speed(const btRigidBody& body, std::span<const Vec3> local,
                                     const btCollisionObject& other, double near, double dt,
                                     ShapeCache& cache);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
