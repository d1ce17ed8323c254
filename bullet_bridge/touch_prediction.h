#pragma once

#include <optional>

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

class btCollisionObject;
class btRigidBody;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// Two bodies that will touch, or do, within the tick.
struct PredictedTouch {
  double time = 0.0;           // s, from now: 0 where they touch already
  double gap = 0.0;            // m, now; negative where the shapes overlap
  double closing_speed = 0.0;  // m/s, then, along the shortest distance, of the points there
};

// Is Bullet still to give the bodies this tick's gravity? It is part of their velocities once it
// has solved.
enum class TickGravity { kToCome, kGiven };

// An upper bound of the speed at which any two points of the bodies can approach, m/s, with what
// gravity is still to add within the tick. `reach`: of the body's shape from its centre, m.
double largest_closing_speed(const btRigidBody& body, double reach, const btCollisionObject& other,
                             double dt, TickGravity gravity = TickGravity::kToCome);

// Will the body touch the other within dt? Both go on as they move now, turn and fall; the time is
// found by conservative advancement (Mirtich 1996): they cannot meet before the gap is closed along
// the shortest distance by their approach and all that their rotation may add to it. The impulse of
// a touch that this foresees is not applied yet, so that a body may still change its
// representation. Of several touches that of the highest closing speed. In doubt (shapes that are
// neither convex nor made of triangles, more than two dozen steps) they touch.
std::optional<PredictedTouch> predict_touch(const btRigidBody& body, const btCollisionObject& other,
                                            double dt, TickGravity gravity = TickGravity::kToCome);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
