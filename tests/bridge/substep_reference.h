#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/contact/penalty.h"
#include "core/operators/time_operator.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {

// A lattice among Bullet's boxes with nothing of the bridge in it: in every substep the lattice is
// integrated against the boxes' present poses, the opposite impulses go to the boxes, and Bullet
// takes a step of the same length, in which it solves all of its own contacts. The penalty law is
// the library's; the geometry and the bookkeeping are not.
class SubstepReference : public SubstepCoupling {
 public:
  SubstepReference(World& world, const PhysicalModel& model) : world_(world) {
    add_object(lattice_, model);
    rebuild_active(lattice_);
    time_.roles_changed();
  }

  void step(double dt) {
    const double gravity = world_->getGravity().y();
    time_.advance(1, dt, {.gravity = {0.0, gravity, 0.0}}, this);
    world_.step(dt);
  }

  PhysicalModel model() const { return extract_model(lattice_, 0); }

  void add_forces(Lattice& lattice, double dt) override {
    for (const auto& body : world_.bodies()) {
      for (std::int32_t p : lattice.dynamic_points) push(lattice, p, *body, dt);
    }
  }
  void advance(Lattice&, double) override {}

 private:
  void push(Lattice& lattice, std::int32_t p, btRigidBody& body, double dt) {
    const PointMotion& point = lattice.motion[p];
    const Vec3 centre = from_bullet(body.getWorldTransform().getOrigin());
    const Mat3 rotation = from_bullet(body.getWorldTransform().getRotation()).toRotationMatrix();
    const Vec3 local = rotation.transpose() * (point.position - centre);
    const auto& shape = static_cast<const btBoxShape&>(*body.getCollisionShape());
    const Vec3 inside = from_bullet(shape.getHalfExtentsWithMargin()) - local.cwiseAbs();
    int axis = 0;
    const double depth = inside.minCoeff(&axis);
    if (depth < 0.0) return;
    const Vec3 normal = rotation.col(axis) * (local[axis] < 0.0 ? -1.0 : 1.0);
    const Vec3 arm = point.position - centre;
    const double reduced = 1.0 / (1.0 / lattice.mass[p] + inverse_mass(body, arm, normal));
    const Vec3 slip = point.velocity - from_bullet(body.getLinearVelocity()) -
                      from_bullet(body.getAngularVelocity()).cross(arm);
    const double separation = slip.dot(normal);
    const PenaltyContact law = law_with(lattice, body);
    const double press = penalty_force(law, reduced, depth, separation);
    const Vec3 force = press * normal +
                       friction_force(law.friction, press, reduced, slip - separation * normal, dt);
    lattice.force[p] += force;
    body.applyImpulse(to_bullet(Vec3(-force * dt)), to_bullet(arm));
  }

  static double inverse_mass(const btRigidBody& body, const Vec3& arm, const Vec3& normal) {
    if (body.isStaticObject()) return 0.0;
    const Vec3 lever = arm.cross(normal);
    const btVector3 turned = body.getInvInertiaTensorWorld() * to_bullet(lever);
    return body.getInvMass() + lever.dot(from_bullet(turned));
  }

  static PenaltyContact law_with(const Lattice& lattice, const btRigidBody& body) {
    const LatticeObject& object = lattice.objects[0];
    const double restitution = object.authored.object.restitution * body.getRestitution();
    return {object.contact_frequency, restitution,
            object.authored.object.friction * body.getFriction()};
  }

  World& world_;
  Lattice lattice_;
  TimeOperator time_{lattice_};
};

}  // namespace limber::bullet::test
