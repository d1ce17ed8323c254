// Group 12: lattices and rigid boxes that fly together and collide, through the co-simulation in a
// world of Bullet's.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "bullet_bridge/co_simulation.h"
#include "core/dynamics/free_rotation.h"
#include "tests/bridge/measure.h"
#include "tests/bridge/world.h"
#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"

namespace limber::reference {
namespace {

using bullet::from_bullet;
using bullet::to_bullet;
using bullet::test::Sums;
using bullet::test::sums_of;
using bullet::test::World;

constexpr double kTick = 1.0 / 240.0;  // s
constexpr double kStepScale = 0.1;     // of the stable step
constexpr double kRestitution = 0.7;   // of each; two share it by product
constexpr double kFriction = 0.0;      // Bullet's acts at two places at once, which costs L

Eigen::Quaterniond orientation_of(const Json& body) {
  const Json& q = body.at("orientation_wxyz");
  return Eigen::Quaterniond(q.at(0), q.at(1), q.at(2), q.at(3)).normalized();
}

PhysicalModel lattice_of(Json body) {
  body["beta"] = body.value("c_over_k", 0.0);
  PhysicalModel model = cubic_lattice(cubic_of(body));
  model.object.friction = kFriction;
  model.object.restitution = kRestitution;
  const Mat3 axes = orientation_of(body).toRotationMatrix();
  place(model, axes, vec3(body.at("com")) - axes * centre_of_mass(model));
  set_in_motion(model, vec3(body.at("velocity")), vec3(body.at("omega_world")));
  return model;
}

// Without Bullet's gyroscopic torque, which does not keep angular momentum: FreeRotation does.
btRigidBody& add_box(World& world, const Json& body) {
  btRigidBody& box =
      world.add_box(vec3(body.at("half_extents")), body.at("mass"), vec3(body.at("com")));
  const btTransform pose(to_bullet(orientation_of(body)), to_bullet(vec3(body.at("com"))));
  box.setCenterOfMassTransform(pose);
  box.setLinearVelocity(to_bullet(vec3(body.at("velocity"))));
  box.setAngularVelocity(to_bullet(vec3(body.at("omega_world"))));
  box.setFriction(kFriction);
  box.setRestitution(kRestitution);
  box.setDamping(0.0, 0.0);
  box.setActivationState(DISABLE_DEACTIVATION);
  box.setFlags(0);
  return box;
}

// Lets the boxes turn as free bodies do. Bullet keeps their angular velocity instead. Those that
// are not where Bullet's own step ends were moved by the co-simulation, which turns them freely.
class FreeRotation : public btActionInterface {
 public:
  explicit FreeRotation(const std::vector<btRigidBody*>& boxes) {
    for (btRigidBody* box : boxes) boxes_.push_back({box, box->getWorldTransform()});
  }

  void updateAction(btCollisionWorld*, btScalar dt) override {
    for (auto& [box, start] : boxes_) {
      btTransform end;
      btTransformUtil::integrateTransform(start, box->getLinearVelocity(),
                                          box->getAngularVelocity(), dt, end);
      if (box->getWorldTransform() == end) turn_freely(*box, start, dt);
      start = box->getWorldTransform();
    }
  }
  void debugDraw(btIDebugDraw*) override {}

 private:
  static void turn_freely(btRigidBody& box, const btTransform& start, double dt) {
    Eigen::Quaterniond orientation = from_bullet(start.getRotation());
    Vec3 omega = from_bullet(box.getAngularVelocity());
    rotate_freely(orientation, omega, from_bullet(box.getInvInertiaDiagLocal()).cwiseInverse(), dt);
    box.setCenterOfMassTransform(
        btTransform(to_bullet(orientation), box.getWorldTransform().getOrigin()));
    box.setAngularVelocity(to_bullet(omega));
  }

  std::vector<std::pair<btRigidBody*, btTransform>> boxes_;
};

class IsolatedSystem {
 public:
  explicit IsolatedSystem(const Json& bodies) {
    // What mends overlaps moves bodies without momentum.
    world_->getSolverInfo().m_erp2 = 0.0;
    world_->getSolverInfo().m_splitImpulse = false;
    for (const Json& body : bodies) {
      if (body.at("type") == "lattice") {
        simulation_.add(lattice_of(body));
      } else if (body.at("type") == "rigid_box") {
        boxes_.push_back(&add_box(world_, body));
      } else {
        throw std::runtime_error("a body is neither a lattice nor a rigid_box");
      }
    }
  }

  Sums sums() const {
    Sums all;
    for (std::size_t i = 0; i < simulation_.object_count(); ++i) {
      all += sums_of(simulation_.model(i));
    }
    for (const btRigidBody* box : boxes_) all += sums_of(*box);
    return all;
  }

  // Returns the largest energy, J.
  double run(double duration) {
    FreeRotation rotation(boxes_);
    world_->addAction(&rotation);  // after that of the co-simulation
    double most = sums().energy(0.0);
    const int ticks = static_cast<int>(std::ceil(duration / kTick - 1e-9));
    for (int i = 0; i < ticks; ++i) {
      world_.step(duration / ticks);
      if (simulation_.failure()) throw std::runtime_error(simulation_.failure()->what);
      most = std::max(most, sums().energy(0.0));
    }
    world_->removeAction(&rotation);
    return most;
  }

 private:
  World world_{0.0};
  bullet::CoSimulation simulation_{
      *world_,
      {.representation = bullet::Representation::kAlwaysFlexible, .step_scale = kStepScale}};
  std::vector<btRigidBody*> boxes_;
};

Json isolated_system(const Case& c) {
  IsolatedSystem system(c.params.at("bodies"));
  const double most_energy = system.run(c.params.at("t_end"));
  const Sums end = system.sums();
  return {{"total_mass", end.mass},
          {"P", to_json(end.momentum)},
          {"L_origin", to_json(end.angular_momentum)},
          {"E0", most_energy}};
}

}  // namespace

Kinds isolated_kinds() { return {{"isolated_system", isolated_system}}; }

}  // namespace limber::reference
