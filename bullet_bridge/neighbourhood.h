#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/dynamics/lattice.h"

class btDiscreteDynamicsWorld;
class btCollisionObject;
class btRigidBody;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

class ShapeCache;

// A body that points may reach, and the box in the world, m, in which they may meet it.
struct NearBody {
  const btCollisionObject* object;
  Vec3 low, high;
};

// The bodies whose bounding boxes the points may reach within dt (their boxes already include their
// own way in this tick), in the order in which the world holds them. Bodies without contact
// response are left out.
std::vector<NearBody> bodies_within_reach(btDiscreteDynamicsWorld& world, const Lattice& lattice,
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
