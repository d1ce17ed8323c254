#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>

#include "bullet_bridge/co_simulation_impl.h"
#include "bullet_bridge/conversions.h"
#include "bullet_bridge/lattice_shape.h"
#include "bullet_bridge/neighbourhood.h"

// Touches that nothing could foresee before Bullet solved, because its solver has just sent a body
// elsewhere. Velocities are final and nothing has moved: to go back to the time of impact takes no
// undoing. What is about to be hit becomes a lattice where it is, with the velocity that it was
// given, and is integrated over the tick after the others.

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// The solver changed its velocity by more than gravity does in the tick; a body keeps that of the
// tick before for its interpolation.
bool is_deflected(const btRigidBody& body, double dt) {
  if (body.isStaticOrKinematicObject() || !body.isActive() || stands_for_lattice(body)) {
    return false;
  }
  constexpr double kRounding = 1e-3;    // m/s
  constexpr double kLeastTwist = 1e-3;  // rad within the tick
  const btVector3 pushed = body.getLinearVelocity() - body.getInterpolationLinearVelocity();
  const btVector3 twisted = body.getAngularVelocity() - body.getInterpolationAngularVelocity();
  return pushed.length() > body.getGravity().length() * dt + kRounding ||
         twisted.length() * dt > kLeastTwist;
}

// Bodies whose boxes the body reaches on its way through the tick.
std::vector<const btCollisionObject*> reached_by(btDiscreteDynamicsWorld& world, btRigidBody& body,
                                                 double dt) {
  btVector3 low, high, end_low, end_high;
  btTransform end;
  body.predictIntegratedTransform(static_cast<btScalar>(dt), end);
  body.getCollisionShape()->getAabb(body.getWorldTransform(), low, high);
  body.getCollisionShape()->getAabb(end, end_low, end_high);
  low.setMin(end_low);
  high.setMax(end_high);
  return bodies_in(world, from_bullet(low), from_bullet(high));
}

}  // namespace

void CoSimulation::Impl::catch_up_with_deflected(double dt) {
  thawing_late_ = true;
  const std::vector<Piece*> others = flexible_pieces();
  for (int i = 0; i < world_.getNumCollisionObjects(); ++i) {
    btCollisionObject& object = *world_.getCollisionObjectArray()[i];
    if (!object.isActive()) continue;
    btRigidBody* body = btRigidBody::upcast(&object);
    if (!body || !is_deflected(*body, dt)) continue;
    for (const btCollisionObject* other : reached_by(world_, *body, dt)) {
      if (other == body || !may_meet(world_, *body, *other)) continue;
      if (Piece* piece = index_.rigid(*body)) consider_pair(*piece, *other, dt);
      if (Piece* piece = index_.rigid(*other)) consider_pair(*piece, *body, dt);
    }
  }
  passing_.clear();  // Bullet has solved their contacts
  thawing_late_ = false;
  if (flexible_pieces().size() > others.size()) step_late(others, dt);
}

// The others have gone through the tick already: they stand still, and so do their contacts.
void CoSimulation::Impl::step_late(const std::vector<Piece*>& others, double dt) {
  for (const Piece* piece : others) set_role(*piece, PointRole::kIdle);
  std::vector<Piece*> late;
  for (Piece* piece : flexible_pieces()) {
    if (std::find(others.begin(), others.end(), piece) == others.end()) late.push_back(piece);
  }
  TimeOperator::LatticeContacts theirs = time_operator_.put_contacts_aside();
  step(late, late_contacts_, ContactSolver::Gravity::kGiven, dt);
  for (const Piece* piece : others) set_role(*piece, PointRole::kDynamic);
  time_operator_.take_contacts_back(std::move(theirs));
  rebuild_active(lattice_);
  time_operator_.roles_changed();
  stepped_late_ = true;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
