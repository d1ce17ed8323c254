#include "bullet_bridge/joint_loads.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include "bullet_bridge/joints.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// N. Bullet's torque is about the centre of mass: that of the force at its place is no couple.
double load_on(const Piece& piece, btTypedConstraint& joint, const btVector3& force,
               const btVector3& torque) {
  const btRigidBody& body = piece.body();
  const btVector3 arm = place_of_joint(joint, body) - body.getCenterOfMassPosition();
  const btVector3 couple = torque - arm.cross(force);
  return force.length() + 2.0 * couple.length() / piece.size;
}

// Bullet fills it in when it solves the joint; its vectors are born with whatever memory held.
void clear(btJointFeedback& feedback) {
  for (btVector3* v : {&feedback.m_appliedForceBodyA, &feedback.m_appliedTorqueBodyA,
                       &feedback.m_appliedForceBodyB, &feedback.m_appliedTorqueBodyB}) {
    v->setZero();
  }
}

// Joints of what sleeps are not solved: what their feedback holds is old.
bool is_solved(const Piece* piece) { return piece && piece->body().isActive(); }

}  // namespace

void JointLoads::begin(btDiscreteDynamicsWorld& world, const PieceIndex& index) {
  entries_.clear();
  for (int i = 0; i < world.getNumConstraints(); ++i) {
    btTypedConstraint& joint = *world.getConstraint(i);
    if (!joint.isEnabled()) continue;
    Piece* a = index.any(joint.getRigidBodyA());
    Piece* b = index.any(joint.getRigidBodyB());
    if (a || b) entries_.push_back({&joint, a, b, {}, joint.getJointFeedback() == nullptr});
  }
  for (Entry& entry : entries_) {  // they stay where they are now
    clear(entry.feedback);
    if (entry.lent) entry.joint->setJointFeedback(&entry.feedback);
  }
}

void JointLoads::end() {
  for (const Entry& entry : entries_) {  // what woke in the tick has that of when it fell asleep
    if (is_solved(entry.a)) entry.a->joint_load = 0.0;
    if (is_solved(entry.b)) entry.b->joint_load = 0.0;
  }
  for (Entry& entry : entries_) {
    btTypedConstraint& joint = *entry.joint;
    if (!joint.getJointFeedback()) continue;
    const btJointFeedback found = *joint.getJointFeedback();
    if (entry.lent) joint.setJointFeedback(nullptr);
    if (is_solved(entry.a)) {
      entry.a->joint_load +=
          load_on(*entry.a, joint, found.m_appliedForceBodyA, found.m_appliedTorqueBodyA);
    }
    if (is_solved(entry.b)) {
      entry.b->joint_load +=
          load_on(*entry.b, joint, found.m_appliedForceBodyB, found.m_appliedTorqueBodyB);
    }
  }
  entries_.clear();
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
