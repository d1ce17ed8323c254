#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <utility>
#include <vector>

#include "bullet_bridge/co_simulation.h"
#include "bullet_bridge/conversions.h"

namespace limber::bullet::test {

inline constexpr double kGravity = 9.81;  // m/s^2, downwards
inline constexpr double kTick = 1.0 / 60.0;

// The same sources are compiled for both precisions of Bullet: what it stores limits what can be
// asked for.
inline double by_precision(double f32, double f64) { return sizeof(btScalar) == 4 ? f32 : f64; }

enum class SolverOwner { kCaller, kWorld };

// A Bullet world that owns what is in it. Bodies neither damp nor sleep unless a test wants it.
class World {
 public:
  explicit World(
      double gravity = kGravity, SolverOwner owner = SolverOwner::kCaller,
      std::unique_ptr<btBroadphaseInterface> broadphase = std::make_unique<btDbvtBroadphase>())
      : broadphase_(std::move(broadphase)),
        world_(&dispatcher_, broadphase_.get(), owner == SolverOwner::kCaller ? &solver_ : nullptr,
               &configuration_) {
    configuration_.setPlaneConvexMultipointIterations();
    configuration_.setConvexConvexMultipointIterations();
    world_.setGravity(to_bullet(Vec3(0.0, -gravity, 0.0)));
    // Bullet pushes overlaps of less than 4 cm apart with velocity, error / tick: at a substep's
    // length that would throw bodies about. Positions are mended without velocity here.
    world_.getSolverInfo().m_splitImpulsePenetrationThreshold = 0;
  }
  ~World() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  btDiscreteDynamicsWorld& operator*() { return world_; }
  btDiscreteDynamicsWorld* operator->() { return &world_; }
  const std::vector<std::unique_ptr<btRigidBody>>& bodies() const { return bodies_; }
  btConstraintSolver& own_solver() { return solver_; }

  // Mass 0 makes it static.
  btRigidBody& add(std::unique_ptr<btCollisionShape> shape, double mass, const Vec3& centre) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0.0) shape->calculateLocalInertia(static_cast<btScalar>(mass), inertia);
    btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(mass), nullptr, shape.get(),
                                                  inertia);
    info.m_startWorldTransform.setOrigin(to_bullet(centre));
    shapes_.push_back(std::move(shape));
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world_.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }

  btRigidBody& add_box(const Vec3& half_extents, double mass, const Vec3& centre) {
    return add(std::make_unique<btBoxShape>(to_bullet(half_extents)), mass, centre);
  }

  // A wide static box with its top at y = 0.
  btRigidBody& add_ground() { return add_box({10.0, 0.5, 10.0}, 0.0, {0.0, -0.5, 0.0}); }

  void step(double tick) {
    world_.stepSimulation(static_cast<btScalar>(tick), 1, static_cast<btScalar>(tick));
  }
  void run(double seconds, double tick) {
    for (double t = 0.5 * tick; t < seconds; t += tick) step(tick);
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace limber::bullet::test
