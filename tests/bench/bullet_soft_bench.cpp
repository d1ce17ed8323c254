// A cube of springs at rest on the floor, one frame of 1/60 s: Bullet's own soft body beside
// Limber's lattice, with what each costs and how far its top sags.

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <vector>

#include "bullet_bridge/co_simulation.h"
#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"
#include "tests/bench/bullet_world.h"

namespace limber::bullet {
namespace {

constexpr double kSide = 0.5;  // m
constexpr double kMass = 1.0;  // kg
constexpr double kFrame = 1.0 / 60.0;
constexpr int kFramesToRest = 300;

// Axial edges, face and body diagonals; its floor is at y = 0.
PhysicalModel cube(int points, double youngs_modulus) {
  Material rubber;
  rubber.density = kMass / (kSide * kSide * kSide);
  rubber.youngs_modulus = youngs_modulus;
  rubber.strain_at_break = 0.5;
  rubber.damping_ratio = 0.05;
  rubber.internal_damping = 5.0;
  rubber.friction = 0.5;
  const int cells = points - 1;
  return with_material(
      box_lattice({cells, cells, cells}, Vec3::Constant(kSide / cells), Vec3::Zero(), "cube"),
      "cube", rubber);
}

// Of the cube's own height, m: how far it stands in the floor does not count.
double sag(const std::vector<Vec3>& points, int along_edge) {
  double bottom = 0.0, top = 0.0;
  for (int z = 0; z < along_edge; ++z) {
    for (int x = 0; x < along_edge; ++x) {
      bottom += points[x + along_edge * along_edge * z].y();
      top += points[x + along_edge * (along_edge - 1 + along_edge * z)].y();
    }
  }
  return kSide - (top - bottom) / (along_edge * along_edge);
}

class SoftWorld {
 public:
  // The cube's springs as links, in random order: in the order of the lattice it collapses.
  SoftWorld(int points, int iterations) : along_edge_(points) {
    world_.setGravity({0, btScalar(-9.81), 0});
    world_.getWorldInfo().m_gravity = {0, btScalar(-9.81), 0};
    world_.getWorldInfo().air_density = 0;
    world_.getWorldInfo().m_sparsesdf.Initialize();
    add_floor();
    add_cube(cube(points, 1.0), iterations);
  }

  ~SoftWorld() {
    world_.removeSoftBody(body_.get());
    world_.removeRigidBody(floor_.get());
  }

  void frame(int substeps) {
    for (int n = 0; n < substeps; ++n) {
      const auto dt = btScalar(kFrame / substeps);
      world_.stepSimulation(dt, 0, dt);
    }
  }

  double sag_now() const {
    std::vector<Vec3> points;
    for (int i = 0; i < body_->m_nodes.size(); ++i) {
      const btVector3& x = body_->m_nodes[i].m_x;
      points.emplace_back(x.x(), x.y(), x.z());
    }
    return sag(points, along_edge_);
  }

  std::size_t links() const { return static_cast<std::size_t>(body_->m_links.size()); }

 private:
  void add_floor() {
    const btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, &floor_shape_);
    floor_ = std::make_unique<btRigidBody>(info);
    floor_->getWorldTransform().setOrigin({0, -1, 0});
    world_.addRigidBody(floor_.get());
  }

  void add_cube(const PhysicalModel& model, int iterations) {
    std::vector<btVector3> nodes;
    for (const Vec3& p : model.geometry.points) {
      nodes.emplace_back(btScalar(p.x()), btScalar(p.y() + 0.01), btScalar(p.z()));
    }
    const std::vector<btScalar> masses(nodes.size(), btScalar(kMass / double(nodes.size())));
    body_ = std::make_unique<btSoftBody>(&world_.getWorldInfo(), int(nodes.size()), nodes.data(),
                                         masses.data());
    for (const Edge& e : model.geometry.edges) body_->appendLink(e.a.value, e.b.value);
    body_->m_materials[0]->m_kLST = 1;  // as stiff as it goes
    body_->m_cfg.piterations = iterations;
    body_->m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
    body_->m_cfg.kDP = btScalar(0.005);
    std::srand(1);  // randomizeConstraints() has a seed of its own; nodes' order has none
    body_->randomizeConstraints();
    world_.addSoftBody(body_.get());
  }

  int along_edge_;
  btSoftBodyRigidBodyCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btSoftRigidDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btBoxShape floor_shape_{{100, 1, 100}};
  std::unique_ptr<btRigidBody> floor_;
  std::unique_ptr<btSoftBody> body_;
};

void report(benchmark::State& state, double sag_m, double updates_per_frame) {
  state.counters["sag_mm"] = 1e3 * sag_m;
  state.counters["spring_updates_per_s"] =
      benchmark::Counter(updates_per_frame, benchmark::Counter::kIsIterationInvariantRate);
}

// state: points along an edge, substeps a frame, iterations a substep.
void bullet_soft(benchmark::State& state) {
  SoftWorld world(static_cast<int>(state.range(0)), static_cast<int>(state.range(2)));
  const int substeps = static_cast<int>(state.range(1));
  for (int n = 0; n < kFramesToRest; ++n) world.frame(substeps);
  for (auto _ : state) world.frame(substeps);
  report(state, world.sag_now(),
         static_cast<double>(world.links()) * static_cast<double>(substeps * state.range(2)));
}

// state: points along an edge, Young's modulus in kPa.
void limber_flexible(benchmark::State& state) {
  bench::BulletWorld bullet;
  bullet.add_floor();
  CoSimulationSettings settings;
  settings.representation = Representation::kAlwaysFlexible;
  CoSimulation limber(bullet.world(), settings);
  const int points = static_cast<int>(state.range(0));
  limber.add(cube(points, 1e3 * static_cast<double>(state.range(1))));
  for (int n = 0; n < kFramesToRest; ++n) bullet.tick();
  const std::uint64_t before = limber.counters().spring_updates;
  for (auto _ : state) bullet.tick();
  if (limber.failure()) state.SkipWithError(limber.failure()->text().c_str());
  const auto updates = static_cast<double>(limber.counters().spring_updates - before);
  report(state, sag(limber.model(0).geometry.points.raw(), points),
         updates / static_cast<double>(state.iterations()));
}

// Four substeps of five iterations are Bullet's best; the others show what more of them buys.
BENCHMARK(bullet_soft)
    ->Name("bullet_soft/lattice")
    ->ArgsProduct({{6, 10, 16, 22}, {4}, {5}})
    ->ArgsProduct({{16}, {1, 16}, {5, 20}})
    ->Args({16, 4, 20})
    ->Unit(benchmark::kMillisecond);

// First moduli at which it sags no more than Bullet's at its best; then what stiffness costs.
BENCHMARK(limber_flexible)
    ->Name("limber_soft/lattice")
    ->Args({6, 140})
    ->Args({10, 22})
    ->Args({16, 5})
    ->Args({22, 3})
    ->ArgsProduct({{16}, {2, 10, 30, 100, 300, 1000, 10000}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace limber::bullet
