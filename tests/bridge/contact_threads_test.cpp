#include <gtest/gtest.h>

#include "core/storage/state_hash.h"
#include "core/threads/parallel_for.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Contacts of several lattices that have nothing in common but the ground: the same bits on any
// number of threads.

namespace limber::bullet::test {
namespace {

constexpr Block kBrick{.cells = {10, 1, 10},
                       .spacing = 0.03,
                       .mass = 4.0,
                       .modulus = 3e5,
                       .strain_at_break = 0.05,
                       .damping_ratio = 0.05};

void add(StateHash& hash, const PhysicalModel& model) {
  for (const Vec3& x : model.geometry.points) hash.add(std::span(x.data(), 3));
  for (PointId p : ids_of(model.points)) hash.add(std::span(model.points[p].velocity.data(), 3));
  for (EdgeId e : ids_of(model.edges)) hash.add(model.edges[e].broken);
}

// Bricks fall on the ground, on boxes that two of them share, on one another, and on a shape that
// Bullet alone knows.
std::uint64_t hash_of_run(int thread_count) {
  set_threads(thread_count);
  World world;
  world.add_ground();
  world.add_box({0.5, 0.1, 0.1}, 3.0, {0.0, 0.1, 0.0});
  const std::array<btVector3, 2> centres{btVector3(0, 0, 0), btVector3(btScalar(0.1), 0, 0)};
  const std::array<btScalar, 2> radii{btScalar(0.1), btScalar(0.1)};
  world.add(std::make_unique<btMultiSphereShape>(centres.data(), radii.data(), 2), 0.0,
            {3.0, 0.1, 0.0});
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  for (const Vec3& at : {Vec3(-0.4, 0.3, 0.0), Vec3(0.4, 0.3, 0.0), Vec3(1.0, 0.1, 0.0),
                         Vec3(1.1, 0.25, 0.1), Vec3(2.0, 0.1, 0.0), Vec3(3.0, 0.3, 0.0)}) {
    simulation.add(make_block(kBrick, at, {0.0, -2.0, 0.0}));
  }
  world.run(0.15, kTick);
  set_threads(1);
  EXPECT_FALSE(simulation.failure());
  StateHash hash;
  for (std::size_t i = 0; i < 6; ++i) add(hash, simulation.model(i));
  for (const auto& body : world.bodies()) {
    for (int k = 0; k < 3; ++k) hash.add(body->getWorldTransform().getOrigin()[k]);
  }
  return hash.value();
}

TEST(ContactThreads, GiveTheBitsOfOneThread) {
  const std::uint64_t alone = hash_of_run(1);
  EXPECT_EQ(hash_of_run(2), alone);
  EXPECT_EQ(hash_of_run(4), alone);
}

}  // namespace
}  // namespace limber::bullet::test
