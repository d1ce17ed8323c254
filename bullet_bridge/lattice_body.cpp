#include "bullet_bridge/lattice_body.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <LinearMath/btMotionState.h>

#include <utility>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

Mat3 inertia_of(const btRigidBody& body) {
  const Mat3 axes = from_bullet(body.getWorldTransform().getRotation()).toRotationMatrix();
  const Vec3 moments = from_bullet(body.getInvInertiaDiagLocal()).cwiseInverse();
  return axes * moments.asDiagonal() * axes.transpose();
}

// Velocity that Bullet adds when it solves.
btVector3 pushed(const btRigidBody& body, double tick) {
  return body.getTotalForce() * body.getInvMass() * static_cast<btScalar>(tick);
}
btVector3 twisted(const btRigidBody& body, double tick) {
  return body.getInvInertiaTensorWorld() * body.getTotalTorque() * static_cast<btScalar>(tick);
}

}  // namespace

LatticeBody::LatticeBody(btDiscreteDynamicsWorld& world, const Lattice& lattice,
                         const BoundaryTracker& boundary, std::span<const std::int32_t> points,
                         std::shared_ptr<PieceBody> heir)
    : shape_(lattice, boundary, points),
      body_(heir ? std::move(heir) : make_piece_body(world, lattice, points)) {
  const ProxyFrame frame = proxy_frame(rigid_motion(lattice.motion, lattice.mass, points));
  shape_.follow(frame.centre, frame.orientation.toRotationMatrix());
  body_->be_lattice(frame, shape_);
  body_->bear_joints(false);
  note_orientation(lattice, points);
  note_body();
}

LatticeBody::LatticeBody(const Lattice& lattice, const BoundaryTracker& boundary,
                         std::span<const std::int32_t> points, std::unique_ptr<RigidProxy> proxy)
    : proxy_(std::move(proxy)), shape_(lattice, boundary, points), body_(proxy_->shared_body()) {
  body_->stop_being_rigid();
  note_orientation(lattice, points);
  note_body();
}

void LatticeBody::note_orientation(const Lattice& lattice, std::span<const std::int32_t> points) {
  const Eigen::Quaterniond best(
      best_rotation(lattice.motion, lattice.authored_position, lattice.mass, points));
  from_authored_ = best.conjugate() * from_bullet(body_->getWorldTransform().getRotation());
}

// Points on a line have no best rotation: the turn about the line is whatever the fit makes it.
Eigen::Quaterniond LatticeBody::orientation_of(const Lattice& lattice,
                                               std::span<const std::int32_t> points) const {
  const Eigen::Quaterniond best(
      best_rotation(lattice.motion, lattice.authored_position, lattice.mass, points));
  return (best * from_authored_).normalized();
}

void LatticeBody::note_body() {
  pose_ = body_->getWorldTransform();
  velocity_ = body_->getLinearVelocity();
  angular_velocity_ = body_->getAngularVelocity();
}

Impulse LatticeBody::impulse_since(const btVector3& velocity,
                                   const btVector3& angular_velocity) const {
  const btVector3 dv = body_->getLinearVelocity() - velocity;
  const btVector3 spun = body_->getAngularVelocity() - angular_velocity;
  Impulse impulse;
  if (!dv.isZero()) impulse.linear = from_bullet(dv) / static_cast<double>(body_->getInvMass());
  if (!spun.isZero()) impulse.angular = inertia_of(*body_) * from_bullet(spun);
  return impulse;
}

bool LatticeBody::take_changes(Lattice& lattice, std::span<const std::int32_t> points,
                               double tick) {
  const bool elsewhere = !(body_->getWorldTransform() == pose_);
  if (elsewhere) teleport(lattice, points);
  Impulse impulse = impulse_since(velocity_, angular_velocity_);
  impulse.linear += tick * from_bullet(body_->getTotalForce());
  impulse.angular += tick * from_bullet(body_->getTotalTorque());
  if (!impulse.is_zero()) push_rigidly(lattice, points, impulse);
  note_body();
  return elsewhere;
}

// Velocities stay as they are, as Bullet's do.
void LatticeBody::teleport(Lattice& lattice, std::span<const std::int32_t> points) const {
  const btTransform& now = body_->getWorldTransform();
  const Vec3 from = from_bullet(pose_.getOrigin()), to = from_bullet(now.getOrigin());
  const bool turned = !(now.getBasis() == pose_.getBasis());
  const Eigen::Quaterniond turn =
      turned ? from_bullet(now.getRotation()) * from_bullet(pose_.getRotation()).conjugate()
             : Eigen::Quaterniond::Identity();
  for (std::int32_t p : points) {
    Vec3& place = lattice.motion[p].position;
    place = to + turn * (place - from);
  }
}

void LatticeBody::show_velocity(const Lattice& lattice, std::span<const std::int32_t> points,
                                double tick) {
  const RigidMotion motion = rigid_motion(lattice.motion, lattice.mass, points);
  velocity_ = to_bullet(motion.velocity);
  angular_velocity_ = to_bullet(motion.angular_velocity);
  // The lattice has had the forces; Bullet is about to give them to what it solves.
  body_->setLinearVelocity(velocity_ - pushed(*body_, tick));
  body_->setAngularVelocity(angular_velocity_ - twisted(*body_, tick));
}

void LatticeBody::show(btDiscreteDynamicsWorld& world, const Lattice& lattice,
                       std::span<const std::int32_t> points, bool joints) {
  const RigidMotion motion = rigid_motion(lattice.motion, lattice.mass, points);
  ProxyFrame frame;
  frame.mass = motion.mass;
  frame.centre = motion.centre;
  frame.orientation = orientation_of(lattice, points);
  const Mat3 axes = frame.orientation.toRotationMatrix();
  const Vec3 moments = (axes.transpose() * motion.inertia * axes).diagonal();
  frame.moments = moments.cwiseMax(kSmallestMomentShare * moments.maxCoeff());
  frame.velocity = motion.velocity;
  frame.angular_velocity = motion.angular_velocity;

  shape_.follow(frame.centre, axes);
  if (proxy_) {
    body_->be_lattice(shape_);
    proxy_.reset();
  }
  body_->follow(frame);
  body_->bear_joints(joints);
  shape_.make_static_when_asked(joints ? nullptr : body_.get());
  if (body_->isInWorld()) world.updateSingleAabb(body_.get());  // the game may have taken it out
  note_body();
  if (joints || !body_->getMotionState()) return;
  body_->getMotionState()->setWorldTransform(pose_);  // should the game ask for the box meanwhile
  body_->seem_movable();
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
