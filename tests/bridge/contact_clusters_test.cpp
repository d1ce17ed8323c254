#include "bullet_bridge/contact_clusters.h"

#include <gtest/gtest.h>

#include <numeric>

#include "bullet_bridge/shapes/shape_cache.h"
#include "core/dynamics/components.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

constexpr Block kBrick{.cells = {10, 1, 10}, .spacing = 0.03, .mass = 4.0, .modulus = 3e5};

// Bricks side by side, 1 mm above y = 0, and the contacts that the world's bodies list with them.
class Contacts {
 public:
  Contacts(World& world, int bricks) {
    for (int i = 0; i < bricks; ++i) {
      add_object(lattice_, make_block(kBrick, {0.5 * i, 0.016, 0.0}));
    }
    rebuild_active(lattice_);
    boundary_.reset(lattice_.breaking);
    const LatticeSurface surface(lattice_, boundary_);
    for (const auto& body : world.bodies()) {
      const int shadow = shadows_.shadow_of(*body);
      obstacles_.emplace_back(*body, shadow, shadows_[shadow], Vec3::Constant(-10.0),
                              Vec3::Constant(10.0), 0.0, shapes_);
      obstacles_.back().list(lattice_, surface, shadows_[shadow], {0.01, 0.0}, 1e-4);
    }
  }

  std::vector<ContactCluster> clusters() const {
    return contact_clusters(obstacles_, shadows_, components(lattice_));
  }

 private:
  Lattice lattice_;
  BoundaryTracker boundary_;
  ShadowSet shadows_;
  ShapeCache shapes_;
  std::vector<Obstacle> obstacles_;
};

std::size_t pairs_of(const ContactCluster& cluster) {
  return std::accumulate(
      cluster.parts.begin(), cluster.parts.end(), std::size_t{0},
      [](std::size_t sum, const ContactCluster::Part& part) { return sum + part.share.size(); });
}

TEST(ContactClusters, OnGroundThatDoesNotMoveAreOneForEachBrick) {
  World world;
  world.add_ground();
  const std::vector<ContactCluster> clusters = Contacts(world, 3).clusters();
  ASSERT_EQ(clusters.size(), 4u);
  EXPECT_TRUE(clusters[0].asks_bullet);
  EXPECT_EQ(pairs_of(clusters[0]), 0u);
  for (int i = 1; i < 4; ++i) {
    EXPECT_FALSE(clusters[i].asks_bullet);
    EXPECT_EQ(pairs_of(clusters[i]), pairs_of(clusters[1]));
    EXPECT_GT(pairs_of(clusters[i]), 11u * 11u);  // the lowest points, and faces
  }
}

TEST(ContactClusters, AreJoinedByABodyThatMoves) {
  World world;
  world.add_ground();
  world.add_box({0.4, 0.01, 0.01}, 1.0, {0.25, 0.04, 0.0});  // on the first and the second
  const std::vector<ContactCluster> clusters = Contacts(world, 3).clusters();
  ASSERT_EQ(clusters.size(), 3u);
  EXPECT_GT(pairs_of(clusters[1]), 2 * pairs_of(clusters[2]));
}

TEST(ContactClusters, AskBulletFromOneThread) {
  World world;
  world.add_ground();
  const btVector3 centre(0, 0, 0);
  const btScalar radius = btScalar(0.1);
  world.add(std::make_unique<btMultiSphereShape>(&centre, &radius, 1), 0.0, {0.5, 0.12, 0.0});
  const std::vector<ContactCluster> clusters = Contacts(world, 3).clusters();
  ASSERT_EQ(clusters.size(), 3u);
  EXPECT_GT(pairs_of(clusters[0]), pairs_of(clusters[1]));  // the second brick
  EXPECT_EQ(pairs_of(clusters[1]), pairs_of(clusters[2]));
}

}  // namespace
}  // namespace limber::bullet::test
