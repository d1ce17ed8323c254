#include "bullet_bridge/stage.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <vector>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Anything that was added to the world: the floor, and bodies.
struct Added {
  OwnedShape shape;
  std::unique_ptr<btRigidBody> body;
};

std::unique_ptr<btRigidBody> make_body(const StageBody& wanted, btCollisionShape& shape) {
  btVector3 inertia(0, 0, 0);
  const auto mass = static_cast<btScalar>(wanted.mass);
  if (wanted.mass > 0.0) shape.calculateLocalInertia(mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
  info.m_startWorldTransform.setOrigin(to_bullet(wanted.centre));
  if (!wanted.rotation.isIdentity(0.0)) {
    info.m_startWorldTransform.setRotation(to_bullet(Eigen::Quaterniond(wanted.rotation)));
  }
  info.m_friction = static_cast<btScalar>(wanted.friction);
  info.m_restitution = static_cast<btScalar>(wanted.restitution);
  auto body = std::make_unique<btRigidBody>(info);
  if (wanted.mass > 0.0) {
    body->setLinearVelocity(to_bullet(wanted.velocity));
    body->setAngularVelocity(to_bullet(wanted.spin));
  }
  return body;
}

std::unique_ptr<btTypedConstraint> make_joint(const StageJoint& joint, btRigidBody& a,
                                              btRigidBody& b) {
  const btVector3 at = to_bullet(joint.at), axis = to_bullet(joint.axis);
  const btTransform to_a = a.getWorldTransform().inverse(), to_b = b.getWorldTransform().inverse();
  switch (joint.kind) {
    case StageJoint::Kind::kHinge:
      return std::make_unique<btHingeConstraint>(a, b, to_a * at, to_b * at, to_a.getBasis() * axis,
                                                 to_b.getBasis() * axis);
    case StageJoint::Kind::kFixed: {
      const btTransform frame(btMatrix3x3::getIdentity(), at);
      return std::make_unique<btFixedConstraint>(a, b, to_a * frame, to_b * frame);
    }
    case StageJoint::Kind::kBall:
      break;
  }
  return std::make_unique<btPoint2PointConstraint>(a, b, to_a * at, to_b * at);
}

}  // namespace

struct Stage::World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::unique_ptr<btStaticPlaneShape> plane;
  std::unique_ptr<btRigidBody> floor;
  std::vector<std::optional<Added>> bodies;  // none: it was removed
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
  std::unique_ptr<CoSimulation> co_simulation;

  World() {
    // Several contact points at once, as Bullet's own examples ask for: small bodies rock
    // otherwise.
    configuration.setPlaneConvexMultipointIterations();
    configuration.setConvexConvexMultipointIterations();
  }

  ~World() {
    for (const auto& joint : joints) world.removeConstraint(joint.get());
    co_simulation.reset();
    for (const auto& added : bodies) {
      if (added) world.removeRigidBody(added->body.get());
    }
    if (floor) world.removeRigidBody(floor.get());
  }

  btRigidBody& body(std::size_t index) const { return *bodies[index]->body; }

  // What rests on the body, or hangs from it, would sleep on in the air without it.
  void wake_neighbours_of(const btRigidBody& body) {
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      if (manifold.getBody0() == &body) manifold.getBody1()->activate();
      if (manifold.getBody1() == &body) manifold.getBody0()->activate();
    }
    for (const auto& joint : joints) {
      if (&joint->getRigidBodyA() == &body) joint->getRigidBodyB().activate();
      if (&joint->getRigidBodyB() == &body) joint->getRigidBodyA().activate();
    }
  }

  void remove_joints_of(const btRigidBody& body) {
    std::erase_if(joints, [&](const std::unique_ptr<btTypedConstraint>& joint) {
      if (&joint->getRigidBodyA() != &body && &joint->getRigidBodyB() != &body) return false;
      world.removeConstraint(joint.get());
      return true;
    });
  }

  std::optional<StageThing> thing_of(const btCollisionObject& object) const {
    if (&object == floor.get()) return StageThing{StageThing::Kind::kFloor, 0};
    if (const auto index = co_simulation->object_of(object)) {
      return StageThing{StageThing::Kind::kObject, *index};
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i] && bodies[i]->body.get() == &object) {
        return StageThing{StageThing::Kind::kBody, i};
      }
    }
    return {};
  }

  std::optional<StageContact> contact_in(const btPersistentManifold& manifold) const {
    StageContact contact;
    double hardest = 0.0;
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& point = manifold.getContactPoint(i);
      const double impulse = point.getAppliedImpulse();
      contact.impulse += impulse;
      if (impulse <= hardest) continue;
      hardest = impulse;
      contact.at = from_bullet(point.getPositionWorldOnB());
    }
    if (contact.impulse <= 0.0) return {};
    const auto first = thing_of(*manifold.getBody0()), second = thing_of(*manifold.getBody1());
    if (!first || !second) return {};
    contact.first = *first;
    contact.second = *second;
    return contact;
  }
};

Stage::Stage(const Vec3& gravity, const CoSimulationSettings& settings)
    : world_(std::make_unique<World>()) {
  world_->world.setGravity(to_bullet(gravity));
  world_->co_simulation = std::make_unique<CoSimulation>(world_->world, settings);
}

Stage::~Stage() = default;
Stage::Stage(Stage&&) noexcept = default;

void Stage::add_floor(double friction) {
  world_->plane = std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0));
  StageBody floor;
  floor.friction = friction;
  world_->floor = make_body(floor, *world_->plane);
  world_->world.addRigidBody(world_->floor.get());
}

std::size_t Stage::add_body(const StageBody& body) {
  OwnedShape shape(body.shape);
  auto made = make_body(body, shape.shape());
  world_->world.addRigidBody(made.get());
  world_->bodies.push_back(Added{std::move(shape), std::move(made)});
  return world_->bodies.size() - 1;
}

void Stage::remove_body(std::size_t body) {
  world_->wake_neighbours_of(world_->body(body));
  world_->remove_joints_of(world_->body(body));
  world_->world.removeRigidBody(&world_->body(body));
  world_->bodies[body].reset();
}

bool Stage::has_body(std::size_t body) const { return world_->bodies[body].has_value(); }

StageMotion Stage::motion(std::size_t index) const {
  const btRigidBody& body = world_->body(index);
  const btTransform& pose = body.getWorldTransform();
  return {from_bullet(pose.getOrigin()), from_bullet(pose.getRotation()).toRotationMatrix(),
          from_bullet(body.getLinearVelocity()), from_bullet(body.getAngularVelocity())};
}

void Stage::set_motion(std::size_t index, const StageMotion& motion) {
  btRigidBody& body = world_->body(index);
  btTransform pose;
  pose.setOrigin(to_bullet(motion.centre));
  pose.setRotation(to_bullet(Eigen::Quaterniond(motion.rotation)));
  world_->wake_neighbours_of(body);
  if (!body.isStaticObject()) {
    body.setLinearVelocity(to_bullet(motion.velocity));
    body.setAngularVelocity(to_bullet(motion.spin));
  }
  body.setCenterOfMassTransform(pose);  // and with it the inertia in the world's axes
  world_->world.updateSingleAabb(&body);
  body.activate(true);
}

void Stage::apply_impulse(std::size_t index, const Vec3& impulse, const Vec3& at) {
  btRigidBody& body = world_->body(index);
  body.activate();
  body.applyImpulse(to_bullet(impulse), to_bullet(at) - body.getCenterOfMassPosition());
}

void Stage::add_joint(const StageJoint& joint) {
  btRigidBody& other = joint.other ? world_->body(*joint.other) : btTypedConstraint::getFixedBody();
  world_->joints.push_back(make_joint(joint, world_->body(joint.body), other));
  world_->world.addConstraint(world_->joints.back().get(), true);
}

void Stage::throw_object(std::size_t object, const Vec3& velocity, const Vec3& spin) {
  for (const PieceView& piece : co_simulation().pieces()) {
    if (piece.object != object) continue;
    piece.body->activate(true);
    piece.body->setLinearVelocity(to_bullet(velocity));
    piece.body->setAngularVelocity(to_bullet(spin));
  }
}

std::optional<StageHit> Stage::ray(const Vec3& from, const Vec3& to) const {
  const btVector3 start = to_bullet(from), end = to_bullet(to);
  btCollisionWorld::ClosestRayResultCallback met(start, end);
  world_->world.rayTest(start, end, met);
  if (!met.hasHit()) return {};
  const auto thing = world_->thing_of(*met.m_collisionObject);
  if (!thing) return {};
  return StageHit{*thing, from_bullet(met.m_hitPointWorld), from_bullet(met.m_hitNormalWorld)};
}

std::vector<StageContact> Stage::contacts() const {
  std::vector<StageContact> contacts;
  for (int i = 0; i < world_->dispatcher.getNumManifolds(); ++i) {
    const auto contact = world_->contact_in(*world_->dispatcher.getManifoldByIndexInternal(i));
    if (contact) contacts.push_back(*contact);
  }
  return contacts;
}

CoSimulation& Stage::co_simulation() { return *world_->co_simulation; }
const CoSimulation& Stage::co_simulation() const { return *world_->co_simulation; }

void Stage::step(double tick) {
  // One substep of exactly this length: maxSubSteps 0 would make Bullet's step variable.
  world_->world.stepSimulation(static_cast<btScalar>(tick), 1, static_cast<btScalar>(tick));
  if (const auto& failure = co_simulation().failure()) throw SimulationError(*failure);
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
