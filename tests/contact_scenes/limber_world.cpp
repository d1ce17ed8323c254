#include <btBulletDynamicsCommon.h>

#include "bullet_bridge/conversions.h"
#include "tests/contact_scenes/flexible_world.h"
#include "tests/contact_scenes/rigid_bodies.h"

namespace limber::bullet::test {
namespace {

class LimberWorld : public FlexibleWorld {
 public:
  explicit LimberWorld(const Scene& scene) : rigid_(world_, scene) {
    CoSimulationSettings settings;
    settings.representation = scene.representation;
    limber_ = std::make_unique<CoSimulation>(world_, settings);
    for (const PhysicalModel& model : scene.flexible) limber_->add(model);
  }

  void step(double tick) override {
    time_ += tick;
    rigid_.move_to(time_);
    world_.stepSimulation(static_cast<btScalar>(tick), 0, static_cast<btScalar>(tick));
  }

  SceneState state() const override {
    SceneState state{time_, {}, rigid_.all()};
    for (std::size_t i = 0; i < limber_->object_count(); ++i) {
      state.flexible.push_back(limber_->model(i));
    }
    return state;
  }

  std::string failure() const override {
    return limber_->failure() ? limber_->failure()->text() : std::string();
  }

 private:
  double time_ = 0.0;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  RigidBodies rigid_;
  std::unique_ptr<CoSimulation> limber_;
};

}  // namespace

std::unique_ptr<FlexibleWorld> limber_world(const Scene& scene) {
  return std::make_unique<LimberWorld>(scene);
}

}  // namespace limber::bullet::test
