#include "bullet_bridge/stage.h"

#include <btBulletDynamicsCommon.h>

#include <vector>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

struct Stage::World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<btRigidBody*> boxes;
  std::unique_ptr<CoSimulation> co_simulation;

  World() {
    // Several contact points at once, as Bullet's own examples ask for: small bodies rock
    // otherwise.
    configuration.setPlaneConvexMultipointIterations();
    configuration.setConvexConvexMultipointIterations();
  }

  ~World() {
    co_simulation.reset();
    for (const auto& body : bodies) world.removeRigidBody(body.get());
  }

  btRigidBody& add(std::unique_ptr<btCollisionShape> shape, double mass, const Vec3& centre,
                   double friction, double restitution) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0.0) shape->calculateLocalInertia(static_cast<btScalar>(mass), inertia);
    btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(mass), nullptr, shape.get(),
                                                  inertia);
    info.m_startWorldTransform.setOrigin(to_bullet(centre));
    info.m_friction = static_cast<btScalar>(friction);
    info.m_restitution = static_cast<btScalar>(restitution);
    bodies.push_back(std::make_unique<btRigidBody>(info));
    shapes.push_back(std::move(shape));
    world.addRigidBody(bodies.back().get());
    return *bodies.back();
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
  world_->add(std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), 0.0,
              Vec3::Zero(), friction, 0.0);
}

int Stage::add_box(const StageBox& box) {
  btRigidBody& body = world_->add(std::make_unique<btBoxShape>(to_bullet(box.half_extents)),
                                  box.mass, box.centre, box.friction, box.restitution);
  world_->boxes.push_back(&body);
  return static_cast<int>(world_->boxes.size()) - 1;
}

std::pair<Vec3, Mat3> Stage::box_pose(int box) const {
  const btTransform& pose = world_->boxes[static_cast<std::size_t>(box)]->getWorldTransform();
  return {from_bullet(pose.getOrigin()), from_bullet(pose.getRotation()).toRotationMatrix()};
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
