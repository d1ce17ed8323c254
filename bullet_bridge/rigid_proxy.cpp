#include "bullet_bridge/rigid_proxy.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/shape_material.h"
#include "core/dynamics/free_rotation.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

std::vector<BodyFace> faces_of(const Lattice& lattice, std::span<const std::int32_t> points,
                               const ProxyFrame& frame) {
  const BodyMotion pose{.centre = frame.centre, .rotation = frame.orientation.toRotationMatrix()};
  return body_faces(faces_in_air(lattice, points), lattice.motion, pose);
}

}  // namespace

RigidState rigid_state(const Lattice& lattice, std::span<const std::int32_t> points) {
  RigidState state;
  state.motion = rigid_motion(lattice.motion, lattice.mass, points);
  state.frame = proxy_frame(
      state.motion, best_rotation(lattice.motion, lattice.authored_position, lattice.mass, points));
  const Mat3 to_local = state.frame.orientation.toRotationMatrix().transpose();
  state.local.reserve(points.size());
  for (std::int32_t p : points) {
    state.local.push_back(to_local * (lattice.motion[p].position - state.frame.centre));
  }
  return state;
}

RigidProxy::RigidProxy(btDiscreteDynamicsWorld& world, const Lattice& lattice,
                       std::span<const std::int32_t> points, RigidState state,
                       std::shared_ptr<PieceBody> body)
    : local_(std::move(state.local)), written_basis_(btMatrix3x3::getIdentity()) {
  written_basis_[0][0] = 2;  // no rotation: nothing was written yet
  const ProxyFrame& frame = state.frame;
  flying_ = {frame.mass, frame.moments, faces_of(lattice, points, frame)};
  shape_ = fit_proxy_shape(shape_material(lattice, points, local_));
  btVector3 middle;
  btScalar radius = 0;
  shape_.shape().getBoundingSphere(middle, radius);
  reach_ = radius + middle.length();
  mass_ = frame.mass;
  moments_ = frame.moments;
  regularised_ = frame.regularised;

  body_ = body ? std::move(body) : make_piece_body(world, lattice, points);
  body_->be_rigid(frame, shape_.shape());
  remember();
}

void RigidProxy::write_points(Lattice& lattice, std::span<const std::int32_t> points) const {
  const Vec3 centre = from_bullet(body_->getWorldTransform().getOrigin());
  const Mat3 rotation = from_bullet(body_->getWorldTransform().getRotation()).toRotationMatrix();
  const Vec3 velocity = from_bullet(body_->getLinearVelocity());
  const Vec3 omega = from_bullet(body_->getAngularVelocity());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 arm = rotation * local_[i];
    lattice.motion[points[i]] = {centre + arm, velocity + omega.cross(arm)};
  }
}

RigidMotion RigidProxy::motion() const {
  RigidMotion motion;
  const Mat3 rotation = from_bullet(body_->getWorldTransform().getRotation()).toRotationMatrix();
  motion.mass = mass_;
  motion.centre = from_bullet(body_->getWorldTransform().getOrigin());
  motion.velocity = from_bullet(body_->getLinearVelocity());
  motion.inertia = rotation * moments_.asDiagonal() * rotation.transpose();
  motion.angular_velocity = from_bullet(body_->getAngularVelocity());
  motion.angular_momentum = motion.inertia * motion.angular_velocity;
  return motion;
}

RigidProxy::Start RigidProxy::start() const {
  const bool as_written = start_pose_.getBasis() == written_basis_ &&
                          start_angular_velocity_ == written_angular_velocity_;
  return {from_bullet(start_pose_.getOrigin()), from_bullet(start_velocity_),
          as_written ? flown_orientation_ : from_bullet(start_pose_.getRotation()),
          as_written ? flown_angular_velocity_ : from_bullet(start_angular_velocity_)};
}

FlightState RigidProxy::start_of_flight() const {
  const Start from = start();
  FlightState state;
  state.centre = from.position;
  state.orientation = from.orientation;
  state.velocity = from.velocity;
  state.angular_momentum =
      from.orientation *
      Vec3(moments_.cwiseProduct(from.orientation.conjugate() * from.angular_velocity));
  return state;
}

Vec3 RigidProxy::to_world(const Vec3& of_body) const {
  return from_bullet(body_->getWorldTransform().getRotation()) * of_body;
}

Vec3 RigidProxy::air_force(const Air& air, double time) const {
  const RigidMotion now = motion();
  const Mat3 rotation = from_bullet(body_->getWorldTransform().getRotation()).toRotationMatrix();
  const BodyMotion pose{now.centre, rotation, now.velocity, now.angular_velocity};
  return rotation.transpose() * rigid_face_wrench(flying_.faces, pose, air, time).force;
}

Vec3 RigidProxy::feel_air(const Air& air, double time, double tick) {
  const Vec3 gravity = from_bullet(body_->getGravity());
  const FlightState before = start_of_flight();
  const FlightState end = flown(flying_, air, gravity, time, tick, before);
  const Vec3 blown = end.velocity - before.velocity - gravity * tick;
  FlightState turned = before;
  turned.angular_momentum = end.angular_momentum;
  const Vec3 spun = angular_velocity(flying_, turned) - start().angular_velocity;
  body_->setLinearVelocity(body_->getLinearVelocity() + to_bullet(blown));
  body_->setAngularVelocity(body_->getAngularVelocity() + to_bullet(spun));
  foreseen_angular_velocity_ = body_->getAngularVelocity();
  flight_end_ = end;
  return before.orientation.conjugate() * Vec3(flying_.mass / tick * blown);
}

void RigidProxy::remember() {
  flight_end_.reset();
  start_pose_ = body_->getWorldTransform();
  start_velocity_ = body_->getLinearVelocity();
  start_angular_velocity_ = foreseen_angular_velocity_ = body_->getAngularVelocity();
}

void RigidProxy::fly(double tick) {
  const Start from = start();
  const Vec3 velocity = from_bullet(body_->getLinearVelocity());
  Vec3 position = from.position + 0.5 * tick * (from.velocity + velocity);
  Eigen::Quaterniond orientation = from.orientation;
  const Vec3 half_twist =
      0.5 * from_bullet(body_->getAngularVelocity() - foreseen_angular_velocity_);
  Vec3 omega = from.angular_velocity + half_twist;
  if (flight_end_) {
    position = flight_end_->centre + 0.5 * tick * (velocity - flight_end_->velocity);
    orientation = turned(flight_end_->orientation, half_twist, tick);
    omega = angular_velocity(flying_, *flight_end_) + half_twist;
  } else {
    rotate_freely(orientation, omega, moments_, tick);
  }
  omega += half_twist;
  const btTransform pose(to_bullet(orientation), to_bullet(position));
  body_->setWorldTransform(pose);
  body_->setInterpolationWorldTransform(pose);
  body_->setAngularVelocity(to_bullet(omega));
  body_->updateInertiaTensor();
  flown_orientation_ = orientation;
  flown_angular_velocity_ = omega;
  written_basis_ = pose.getBasis();
  written_angular_velocity_ = body_->getAngularVelocity();
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
