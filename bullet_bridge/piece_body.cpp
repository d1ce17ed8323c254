#include "bullet_bridge/piece_body.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/joints.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Bullet puts a body to sleep that stayed below these for two seconds; its defaults (0.8 m/s and
// 1 rad/s) would stop a shard that is still sliding.
constexpr double kSleepSpeed = 0.05;         // m/s
constexpr double kSleepAngularSpeed = 0.25;  // rad/s

constexpr int kNoResponse = btCollisionObject::CF_NO_CONTACT_RESPONSE;
constexpr int kStatic = btCollisionObject::CF_STATIC_OBJECT;

}  // namespace

PieceBody::PieceBody(btDiscreteDynamicsWorld& world, const btRigidBodyConstructionInfo& info)
    : btRigidBody(info), world_(world) {
  setFlags(0);  // gyroscopic torque is RigidProxy::fly()'s business: Bullet's loses momentum
}

PieceBody::~PieceBody() { leave(); }

void PieceBody::be_rigid(const ProxyFrame& frame, btCollisionShape& shape) {
  leave();
  take_frame(frame);
  setCollisionShape(&shape);
  if (lattice_) {
    lattice_ = false;
    setIgnoreCollisionCheck(this, false);
    setFlags(getFlags() & ~BT_DISABLE_WORLD_GRAVITY);
    setCollisionFlags((getCollisionFlags() & ~kStatic) | responses_);
    forceActivationState(never_sleeps_ ? DISABLE_DEACTIVATION : ACTIVE_TAG);
    setDeactivationTime(0);
  }
  enter();
}

void PieceBody::be_lattice(const ProxyFrame& frame, btCollisionShape& shape) {
  leave();
  take_frame(frame);
  be_lattice(shape);
}

void PieceBody::be_lattice(btCollisionShape& shape) {
  leave();
  if (!lattice_) stop_being_rigid();
  setCollisionFlags(getCollisionFlags() & ~(kNoResponse | kStatic));
  setCollisionShape(&shape);
  enter();
}

// Bullet asks checkCollideWithOverride() only of what has somebody on its list of those that it
// does not collide with: that is itself.
void PieceBody::stop_being_rigid() {
  lattice_ = true;
  setIgnoreCollisionCheck(this, true);
  never_sleeps_ = getActivationState() == DISABLE_DEACTIVATION;
  forceActivationState(DISABLE_DEACTIVATION);
  responses_ = getCollisionFlags() & kNoResponse;
  setCollisionFlags(getCollisionFlags() | kNoResponse);
  // Bullet gave this tick's gravity already, unless it slept: then no force was kept.
  if (!getTotalForce().isZero()) applyCentralForce(-getGravity() / getInvMass());
  setGravity(btVector3(0, 0, 0));
  setFlags(getFlags() | BT_DISABLE_WORLD_GRAVITY);
}

void PieceBody::bear_joints(bool joints) {
  setCollisionFlags(joints ? getCollisionFlags() & ~kStatic : getCollisionFlags() | kStatic);
}

void PieceBody::take_frame(const ProxyFrame& frame) {
  const btTransform before = getWorldTransform();
  follow(frame);
  move_joint_frames(world_, *this, before, getWorldTransform());
}

void PieceBody::follow(const ProxyFrame& frame) {
  const int flags = getCollisionFlags();  // setMassProps() would clear CF_STATIC_OBJECT
  setMassProps(static_cast<btScalar>(frame.mass), to_bullet(frame.moments));
  setCollisionFlags(flags);
  setLinearVelocity(to_bullet(frame.velocity));
  setAngularVelocity(to_bullet(frame.angular_velocity));
  setCenterOfMassTransform(btTransform(to_bullet(frame.orientation), to_bullet(frame.centre)));
}

void PieceBody::enter() {
  if (group_ == 0 && mask_ == 0) {
    world_.addRigidBody(this);
  } else {
    world_.addRigidBody(this, group_, mask_);
  }
}

void PieceBody::leave() {
  if (!isInWorld()) return;
  group_ = getBroadphaseHandle()->m_collisionFilterGroup;
  mask_ = getBroadphaseHandle()->m_collisionFilterMask;
  world_.removeRigidBody(this);
}

std::shared_ptr<PieceBody> make_piece_body(btDiscreteDynamicsWorld& world, const Lattice& lattice,
                                           std::span<const std::int32_t> points) {
  btRigidBody::btRigidBodyConstructionInfo info(1, nullptr, nullptr);  // mass comes with a frame
  const ObjectAttributes& attributes =
      lattice.objects[lattice.point_object[points[0]]].authored.object;
  info.m_friction = static_cast<btScalar>(attributes.friction);
  info.m_restitution = static_cast<btScalar>(attributes.restitution);
  info.m_linearSleepingThreshold = static_cast<btScalar>(kSleepSpeed);
  info.m_angularSleepingThreshold = static_cast<btScalar>(kSleepAngularSpeed);
  return std::make_shared<PieceBody>(world, info);
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
