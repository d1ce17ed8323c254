#include "bullet_bridge/joints.h"

#include <btBulletDynamicsCommon.h>

#include <optional>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// All joints but gears have a frame in either body. Bullet has no common interface to them.
std::optional<btTransform> frame_of(btTypedConstraint& joint, bool in_a) {
  const auto either = [in_a](auto& kind) -> btTransform {
    return in_a ? kind.getFrameOffsetA() : kind.getFrameOffsetB();
  };
  if (const auto* ball = dynamic_cast<btPoint2PointConstraint*>(&joint)) {
    return btTransform(btMatrix3x3::getIdentity(),
                       in_a ? ball->getPivotInA() : ball->getPivotInB());
  }
  if (auto* hinge = dynamic_cast<btHingeConstraint*>(&joint)) return either(*hinge);
  if (auto* slider = dynamic_cast<btSliderConstraint*>(&joint)) return either(*slider);
  if (auto* cone = dynamic_cast<btConeTwistConstraint*>(&joint)) return either(*cone);
  if (auto* d6 = dynamic_cast<btGeneric6DofConstraint*>(&joint)) return either(*d6);
  if (auto* d6 = dynamic_cast<btGeneric6DofSpring2Constraint*>(&joint)) return either(*d6);
  return {};
}

template <class Kind>
void set_either(Kind& kind, bool in_a, const btTransform& frame) {
  kind.setFrames(in_a ? frame : btTransform(kind.getFrameOffsetA()),
                 in_a ? btTransform(kind.getFrameOffsetB()) : frame);
}

void set_frame(btTypedConstraint& joint, bool in_a, const btTransform& frame) {
  if (auto* ball = dynamic_cast<btPoint2PointConstraint*>(&joint)) {
    in_a ? ball->setPivotA(frame.getOrigin()) : ball->setPivotB(frame.getOrigin());
  } else if (auto* hinge = dynamic_cast<btHingeConstraint*>(&joint)) {
    set_either(*hinge, in_a, frame);
  } else if (auto* slider = dynamic_cast<btSliderConstraint*>(&joint)) {
    set_either(*slider, in_a, frame);
  } else if (auto* cone = dynamic_cast<btConeTwistConstraint*>(&joint)) {
    set_either(*cone, in_a, frame);
  } else if (auto* d6 = dynamic_cast<btGeneric6DofConstraint*>(&joint)) {
    set_either(*d6, in_a, frame);
  } else if (auto* d6_2 = dynamic_cast<btGeneric6DofSpring2Constraint*>(&joint)) {
    set_either(*d6_2, in_a, frame);
  }
}

void turn_gear_axis(btGearConstraint& gear, bool in_a, const btMatrix3x3& turn) {
  btVector3 axis = turn * (in_a ? gear.getAxisA() : gear.getAxisB());
  in_a ? gear.setAxisA(axis) : gear.setAxisB(axis);
}

}  // namespace

std::unordered_set<const btRigidBody*> jointed_bodies(const btDiscreteDynamicsWorld& world) {
  std::unordered_set<const btRigidBody*> bodies;
  for (int i = 0; i < world.getNumConstraints(); ++i) {
    const btTypedConstraint& joint = *world.getConstraint(i);
    if (!joint.isEnabled()) continue;
    bodies.insert(&joint.getRigidBodyA());
    bodies.insert(&joint.getRigidBodyB());
  }
  return bodies;
}

std::vector<btTypedConstraint*> joints_of(const btDiscreteDynamicsWorld& world,
                                          const btRigidBody& body) {
  std::vector<btTypedConstraint*> joints;
  for (int i = 0; i < world.getNumConstraints(); ++i) {
    auto* joint = const_cast<btTypedConstraint*>(world.getConstraint(i));
    const bool holds = &joint->getRigidBodyA() == &body || &joint->getRigidBodyB() == &body;
    if (holds) joints.push_back(joint);
  }
  return joints;
}

btVector3 place_of_joint(btTypedConstraint& joint, const btRigidBody& body) {
  const btTransform& pose = body.getWorldTransform();
  const std::optional<btTransform> frame = frame_of(joint, &joint.getRigidBodyA() == &body);
  return frame ? pose * frame->getOrigin() : pose.getOrigin();
}

void move_joint_frames(const btDiscreteDynamicsWorld& world, const btRigidBody& body,
                       const btTransform& from, const btTransform& to) {
  const btTransform change = to.inverse() * from;
  for (btTypedConstraint* joint : joints_of(world, body)) {
    const bool in_a = &joint->getRigidBodyA() == &body;
    if (const auto frame = frame_of(*joint, in_a)) set_frame(*joint, in_a, change * *frame);
    if (auto* gear = dynamic_cast<btGearConstraint*>(joint)) {
      turn_gear_axis(*gear, in_a, change.getBasis());
    }
  }
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
