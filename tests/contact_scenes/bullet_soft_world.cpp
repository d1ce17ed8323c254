#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

#include "bullet_bridge/conversions.h"
#include "core/operators/boundary_operator.h"
#include "tests/contact_scenes/flexible_world.h"
#include "tests/contact_scenes/rigid_bodies.h"

namespace limber::bullet::test {
namespace {

constexpr int kStepsPerTick = 4;
constexpr int kIterations = 5;
// How far nodes stay off what is rigid, and faces off nodes, m. Bullet's own 0.25 is made for
// bodies of many metres.
constexpr double kSoftMargin = 0.01;
constexpr double kVoxel = 0.05;  // m, of the distance fields of rigid bodies; Bullet's own: 0.25

std::unique_ptr<btSoftBody> with_nodes(btSoftBodyWorldInfo& world, const PhysicalModel& model) {
  std::vector<btVector3> nodes;
  std::vector<btScalar> masses;
  for (PointId p : ids_of(model.points)) {
    nodes.push_back(to_bullet(model.geometry.points[p]));
    masses.push_back(static_cast<btScalar>(model.points[p].pinned ? 0.0 : model.points[p].mass));
  }
  auto body = std::make_unique<btSoftBody>(&world, int(nodes.size()), nodes.data(), masses.data());
  for (PointId p : ids_of(model.points)) {
    body->m_nodes[p.value].m_v = to_bullet(model.points[p].velocity);
  }
  return body;
}

// What is seen of a solid; of a sheet each triangle once.
void append_faces(btSoftBody& body, const PhysicalModel& model) {
  const SurfaceModel surface = boundary(model);
  std::set<std::array<int, 3>> known;
  for (const SurfaceTriangle& triangle : surface.triangles) {
    std::array<int, 3> nodes;
    for (int i = 0; i < 3; ++i) nodes[i] = surface.source_point[triangle.corners[i]].value;
    std::array<int, 3> sorted = nodes;
    std::sort(sorted.begin(), sorted.end());
    if (known.insert(sorted).second) body.appendFace(nodes[0], nodes[1], nodes[2]);
  }
}

std::unique_ptr<btSoftBody> make_soft_body(btSoftBodyWorldInfo& world, const PhysicalModel& model) {
  auto body = with_nodes(world, model);
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    body->appendLink(model.geometry.edges[e].a.value, model.geometry.edges[e].b.value);
  }
  append_faces(*body, model);
  body->m_materials[0]->m_kLST = 1;  // as stiff as it goes
  body->m_cfg.piterations = kIterations;
  body->m_cfg.collisions = btSoftBody::fCollision::SDF_RS | btSoftBody::fCollision::VF_SS;
  body->m_cfg.kDP = btScalar(0.005);
  body->m_cfg.kDF = static_cast<btScalar>(model.object.friction);
  body->getCollisionShape()->setMargin(btScalar(kSoftMargin));
  std::srand(1);  // randomizeConstraints() has a seed of its own; nodes' order has none
  body->randomizeConstraints();
  return body;
}

class BulletSoftWorld : public FlexibleWorld {
 public:
  explicit BulletSoftWorld(const Scene& scene) : models_(scene.flexible), rigid_(world_, scene) {
    world_.getWorldInfo().m_gravity = world_.getGravity();
    world_.getWorldInfo().air_density = 0;
    world_.getWorldInfo().m_sparsesdf.setDefaultVoxelsz(btScalar(kVoxel));
    for (PhysicalModel& model : models_) {
      soft_.push_back(make_soft_body(world_.getWorldInfo(), model));
      world_.addSoftBody(soft_.back().get());
      for (EdgeAttributes& edge : model.edges) edge.stiffness = 0.0;
    }
  }

  ~BulletSoftWorld() override {
    for (const auto& body : soft_) world_.removeSoftBody(body.get());
  }

  void step(double tick) override {
    const double dt = tick / kStepsPerTick;
    for (int n = 0; n < kStepsPerTick; ++n) {
      time_ += dt;
      rigid_.move_to(time_);
      world_.stepSimulation(static_cast<btScalar>(dt), 0, static_cast<btScalar>(dt));
    }
    world_.getWorldInfo().m_sparsesdf.GarbageCollect();
  }

  SceneState state() const override {
    SceneState state{time_, models_, rigid_.all()};
    for (std::size_t i = 0; i < models_.size(); ++i) {
      PhysicalModel& model = state.flexible[i];
      for (PointId p : ids_of(model.points)) {
        const btSoftBody::Node& node = soft_[i]->m_nodes[p.value];
        model.geometry.points[p] = from_bullet(node.m_x);
        model.points[p].velocity = from_bullet(node.m_v);
      }
    }
    return state;
  }

 private:
  double time_ = 0.0;
  std::vector<PhysicalModel> models_;  // as they began, without stiffness
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  RigidBodies rigid_;
  std::vector<std::unique_ptr<btSoftBody>> soft_;
};

}  // namespace

std::unique_ptr<FlexibleWorld> bullet_soft_world(const Scene& scene) {
  return std::make_unique<BulletSoftWorld>(scene);
}

}  // namespace limber::bullet::test
