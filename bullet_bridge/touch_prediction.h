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
  double gap = 0.0;            // m, negative where the shapes overlap
  double closing_speed = 0.0;  // m/s, along the shortest distance, of the points there
};

// An upper bound of the speed at which any two points of the bodies can approach, m/s, with what
// gravity adds within the tick.
double largest_closing_speed(const btCollisionObject& a, const btCollisionObject& b, double dt);

// Will the body touch the other within dt? Conservative: the gap along the shortest distance
// against what the bodies can close, with their rotation; the normal may swing meanwhile. The
// impulse of a touch that it foresees is not applied yet, so that a body may still change its
// representation. Concave partners count as touched when their pair exists.
std::optional<PredictedTouch> predict_touch(const btRigidBody& body, const btCollisionObject& other,
                                            double dt);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
