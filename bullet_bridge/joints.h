#pragma once

#include <LinearMath/btTransform.h>

#include <unordered_set>
#include <vector>

#include "bullet_bridge/precision.h"

class btDiscreteDynamicsWorld;
class btRigidBody;
class btTypedConstraint;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A game's constraints in Bullet's world, here called joints. Bullet keeps them in the world; a
// body's own list holds only those that let the joined bodies pass each other.

// Bodies with an enabled joint; look-ups only.
std::unordered_set<const btRigidBody*> jointed_bodies(const btDiscreteDynamicsWorld& world);

// The joints of one body, enabled or not, in the order of the world.
std::vector<btTypedConstraint*> joints_of(const btDiscreteDynamicsWorld& world,
                                          const btRigidBody& body);

// Where the joint holds the body, world, m. The centre of mass for kinds that hold it nowhere.
btVector3 place_of_joint(btTypedConstraint& joint, const btRigidBody& body);

// The body's frame is about to go from `from` to `to` while its material stays: its joints' frames
// in it change so that they stay where they are in the world.
void move_joint_frames(const btDiscreteDynamicsWorld& world, const btRigidBody& body,
                       const btTransform& from, const btTransform& to);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
