#include "bullet_bridge/stage.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

std::unique_ptr<btRigidBody> make_body(const StageBody& wanted, btCollisionShape& shape,
                                       const std::optional<PrincipalFrame>& frame = {}) {
  btVector3 inertia(0, 0, 0);
  const auto mass = static_cast<btScalar>(wanted.mass);
  if (wanted.mass > 0.0) shape.calculateLocalInertia(mass, inertia);
  if (frame) inertia = to_bullet(frame->moments);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
  info.m_startWorldTransform.setOrigin(to_bullet(wanted.centre));
  const Mat3 rotation = frame ? Mat3(wanted.rotation * frame->axes) : wanted.rotation;
  if (!rotation.isIdentity(0.0)) {
    info.m_startWorldTransform.setRotation(to_bullet(Eigen::Quaterniond(rotation)));
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
  // Anything that was added to the world: the floor, and bodies.
  struct Added {
    OwnedShape shape;
    Mat3 axes;  // of the body in the frame that it is spoken of in
    std::unique_ptr<btRigidBody> body;
  };

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
    const auto index = static_cast<std::size_t>(object.getUserIndex());
    const bool own = index < bodies.size() && bodies[index] && bodies[index]->body.get() == &object;
    if (own) return StageThing{StageThing::Kind::kBody, index};
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
  std::optional<PrincipalFrame> frame;
  const auto* compound = std::get_if<CompoundShape>(&body.shape);
  if (compound && body.mass > 0.0) frame = principal_frame(*compound, body.mass);
  const Mat3 axes = frame ? frame->axes : Mat3(Mat3::Identity());
  OwnedShape shape(body.shape, axes);
  auto made = make_body(body, shape.shape(), frame);
  const std::size_t index = world_->bodies.size();
  made->setUserIndex(static_cast<int>(index));
  world_->world.addRigidBody(made.get());
  world_->bodies.push_back(World::Added{std::move(shape), axes, std::move(made)});
  return index;
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
  const Mat3 rotation = from_bullet(pose.getRotation()).toRotationMatrix();
  const Mat3& axes = world_->bodies[index]->axes;
  return {from_bullet(pose.getOrigin()),
          axes.isIdentity(0.0) ? rotation : Mat3(rotation * axes.transpose()),
          from_bullet(body.getLinearVelocity()), from_bullet(body.getAngularVelocity())};
}

Vec3 Stage::centre(std::size_t index) const {
  return from_bullet(world_->body(index).getCenterOfMassPosition());
}

void Stage::set_motion(std::size_t index, const StageMotion& motion) {
  btRigidBody& body = world_->body(index);
  btTransform pose;
  pose.setOrigin(to_bullet(motion.centre));
  pose.setRotation(
      to_bullet(Eigen::Quaterniond(Mat3(motion.rotation * world_->bodies[index]->axes))));
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
  world_->body(joint.body).activate();
  other.activate();
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

namespace {

// Things that a shape reaches into; Bullet tells of points that are only near as well.
struct Overlapping : btCollisionWorld::ContactResultCallback {
  const btCollisionObject* own = nullptr;
  std::vector<const btCollisionObject*> met;

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int, int,
                           const btCollisionObjectWrapper* b, int, int) override {
    if (point.getDistance() > 0) return 0;
    const btCollisionObject* const first = a->getCollisionObject();
    met.push_back(first == own ? b->getCollisionObject() : first);
    return 0;
  }
};

// Each pair once: several pieces of an object may press on the same thing.
class ContactList {
 public:
  void add(const StageContact& contact) {
    const auto [place, is_new] =
        place_of_.try_emplace(std::minmax(contact.first, contact.second), contacts_.size());
    if (is_new) return contacts_.push_back(contact), hardest_.push_back(contact.impulse);
    StageContact& known = contacts_[place->second];
    known.impulse += contact.impulse;
    double& hardest = hardest_[place->second];
    if (contact.impulse <= hardest) return;
    hardest = contact.impulse;
    known.at = contact.at;
  }
  std::vector<StageContact> take() { return std::move(contacts_); }

 private:
  std::vector<StageContact> contacts_;
  std::vector<double> hardest_;  // N s, of one of those that were added
  std::map<std::pair<StageThing, StageThing>, std::size_t> place_of_;
};

}  // namespace

std::vector<StageThing> Stage::overlaps(const SolidShape& shape, const Vec3& centre,
                                        const Mat3& rotation) const {
  const OwnedShape owned(std::visit([](const auto& s) { return StageShape(s); }, shape));
  btCollisionObject probe;
  probe.setCollisionShape(&owned.shape());
  probe.setWorldTransform(btTransform(to_bullet(Eigen::Quaterniond(rotation)), to_bullet(centre)));
  Overlapping seen;
  seen.own = &probe;
  world_->world.contactTest(&probe, seen);
  std::vector<StageThing> things;
  for (const btCollisionObject* object : seen.met) {
    if (const auto thing = world_->thing_of(*object)) things.push_back(*thing);
  }
  std::ranges::sort(things);
  things.erase(std::unique(things.begin(), things.end()), things.end());
  return things;
}

std::vector<StageContact> Stage::contacts() const {
  ContactList contacts;
  for (int i = 0; i < world_->dispatcher.getNumManifolds(); ++i) {
    const auto contact = world_->contact_in(*world_->dispatcher.getManifoldByIndexInternal(i));
    if (contact) contacts.add(*contact);
  }
  for (const LatticeContact& lattice : co_simulation().lattice_contacts()) {
    std::optional<StageThing> other;
    if (lattice.other) other = StageThing{StageThing::Kind::kObject, *lattice.other};
    if (lattice.body) other = world_->thing_of(*lattice.body);
    if (!other) continue;
    const StageThing object{StageThing::Kind::kObject, lattice.object};
    contacts.add({object, *other, lattice.at, lattice.impulse});
  }
  return contacts.take();
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
