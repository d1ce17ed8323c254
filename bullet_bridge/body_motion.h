#pragma once

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

class btCollisionObject;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// How an object of Bullet's world moves just now, world frame.
struct BodySpeeds {
  Vec3 velocity = Vec3::Zero();          // m/s, of its origin
  Vec3 angular_velocity = Vec3::Zero();  // rad/s
};

// Of rigid bodies, and of links and bases of multi-bodies, whose velocity follows from those of the
// joints. Zero for anything else.
BodySpeeds motion_of(const btCollisionObject& object);

// m, of the object's shape from its origin.
double reach_of(const btCollisionObject& object);

// m/s: no point of the object's shape is faster.
double largest_speed(const BodySpeeds& motion, const btCollisionObject& object);

// What an impulse moves: rigid bodies that are neither static nor kinematic. Links of multi-bodies
// are none, they are met as kinematic bodies are.
bool is_movable(const btCollisionObject& object);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
