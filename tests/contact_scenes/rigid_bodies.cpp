#include "tests/contact_scenes/rigid_bodies.h"

#include "bullet_bridge/conversions.h"

namespace limber::bullet::test {
namespace {

std::unique_ptr<btRigidBody> make_body(const RigidSpec& spec, btMotionState* motion) {
  const auto mass = static_cast<btScalar>(spec.mass);
  btVector3 inertia(0, 0, 0);
  if (spec.mass > 0.0) spec.shape->calculateLocalInertia(mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, motion, spec.shape.get(), inertia);
  info.m_startWorldTransform = btTransform(to_bullet(spec.rotation), to_bullet(spec.position));
  info.m_friction = static_cast<btScalar>(spec.friction);
  auto body = std::make_unique<btRigidBody>(info);
  body->setLinearVelocity(to_bullet(spec.velocity));
  return body;
}

}  // namespace

RigidBodies::RigidBodies(btDiscreteDynamicsWorld& world, const Scene& scene)
    : world_(world), specs_(scene.rigid) {
  world_.setGravity(to_bullet(Vec3(0.0, -scene.gravity, 0.0)));
  for (const RigidSpec& spec : specs_) {
    motions_.push_back(spec.path ? std::make_unique<KinematicState>() : nullptr);
    if (spec.path) {
      motions_.back()->pose = btTransform(to_bullet(spec.rotation), to_bullet(spec.path(0.0)));
    }
    bodies_.push_back(make_body(spec, motions_.back().get()));
    btRigidBody& body = *bodies_.back();
    if (spec.path) {
      body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
      body.setActivationState(DISABLE_DEACTIVATION);
    }
    world_.addRigidBody(&body);
  }
}

RigidBodies::~RigidBodies() {
  for (const auto& body : bodies_) world_.removeRigidBody(body.get());
}

void RigidBodies::move_to(double time) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (motions_[i]) motions_[i]->pose.setOrigin(to_bullet(specs_[i].path(time)));
  }
}

std::vector<const btRigidBody*> RigidBodies::all() const {
  std::vector<const btRigidBody*> bodies;
  for (const auto& body : bodies_) bodies.push_back(body.get());
  return bodies;
}

}  // namespace limber::bullet::test
