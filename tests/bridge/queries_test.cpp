#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// What the rest of a game sees of a flexible piece: rays, sweeps, contact tests, wheels, pictures.

namespace limber::bullet::test {
namespace {

// A soft block of 0.3 m about the origin, without gravity, as a lattice.
struct Scene {
  World world{0.0};
  CoSimulation simulation{*world, settings_for(Representation::kAlwaysFlexible)};

  explicit Scene(const PhysicalModel& model = make_block({.modulus = 1e6}, Vec3::Zero())) {
    simulation.add(model);
  }
  btRigidBody& body() { return *simulation.pieces().at(0).body; }
};

btCollisionWorld::ClosestRayResultCallback ray(World& world, const Vec3& from, const Vec3& to) {
  btCollisionWorld::ClosestRayResultCallback hit(to_bullet(from), to_bullet(to));
  world->rayTest(hit.m_rayFromWorld, hit.m_rayToWorld, hit);
  return hit;
}

// m: coordinates of a few decimetres as Bullet's scalars, and what its queries make of them.
double precision() { return by_precision(1e-5, 1e-12); }

TEST(Query, RayHitsTheSurfaceOfALattice) {
  Scene scene;
  const auto hit = ray(scene.world, {0.02, 2.0, 0.03}, {0.02, -2.0, 0.03});
  ASSERT_TRUE(hit.hasHit());
  EXPECT_EQ(hit.m_collisionObject, &scene.body());
  EXPECT_NEAR(hit.m_hitPointWorld.y(), 0.15, precision());
  EXPECT_NEAR(hit.m_hitNormalWorld.y(), 1.0, precision());
  EXPECT_EQ(scene.simulation.object_of(*hit.m_collisionObject), 0u);
}

TEST(Query, RayBesideALatticeHitsNothing) {
  Scene scene;
  EXPECT_FALSE(ray(scene.world, {0.16, 2.0, 0.0}, {0.16, -2.0, 0.0}).hasHit());
}

// Not where it was, nor where its box is: where it has been bent to.
TEST(Query, RayHitsADeformedLatticeWhereItIsNow) {
  PhysicalModel model = make_block({.cells = {6, 1, 1}, .modulus = 1e6}, Vec3::Zero());
  for (PointId p : ids_of(model.points)) {
    Vec3& x = model.geometry.points[p];
    x.y() += x.x() * x.x();
    model.points[p].pinned = true;
  }
  Scene scene(model);
  scene.world.step(kTick);
  for (double x : {-0.25, -0.1, 0.0, 0.2}) {
    // Between points the surface is straight: x^2 lies below its chord by at most h^2 / 4.
    const auto hit = ray(scene.world, {x, 2.0, 0.0}, {x, -2.0, 0.0});
    ASSERT_TRUE(hit.hasHit()) << x;
    EXPECT_NEAR(hit.m_hitPointWorld.y(), 0.05 + x * x + 0.5 * 0.0025, 0.5 * 0.0025 + 1e-5) << x;
  }
}

TEST(Query, RayFollowsAMovingLattice) {
  Scene scene(make_block({.modulus = 1e6}, Vec3::Zero(), {3.0, 1.0, 0.0}));
  scene.world.run(0.5, kTick);
  const double y = scene.simulation.pieces().at(0).motion.centre.y();
  const auto hit = ray(scene.world, {1.5, 5.0, 0.01}, {1.5, -5.0, 0.01});
  ASSERT_TRUE(hit.hasHit());
  EXPECT_NEAR(y, 0.5, precision());
  EXPECT_NEAR(hit.m_hitPointWorld.y(), y + 0.15, precision());
  EXPECT_FALSE(ray(scene.world, {0.0, 5.0, 0.01}, {0.0, -5.0, 0.01}).hasHit());
}

struct TriangleOfRay : btCollisionWorld::ClosestRayResultCallback {
  using ClosestRayResultCallback::ClosestRayResultCallback;
  int triangle = -1;
  btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool in_world) override {
    if (result.m_localShapeInfo) triangle = result.m_localShapeInfo->m_triangleIndex;
    return ClosestRayResultCallback::addSingleResult(result, in_world);
  }
};

// The second object's faces are numbered from zero as well.
TEST(Query, RayNamesTheFaceOfTheModel) {
  Scene scene;
  scene.simulation.add(make_block({.modulus = 1e6}, {1.0, 0.0, 0.0}));
  TriangleOfRay hit(btVector3(1, 2, 0), btVector3(1, -2, 0));
  hit.m_rayFromWorld += btVector3(btScalar(0.02), 0, btScalar(0.03));
  hit.m_rayToWorld += btVector3(btScalar(0.02), 0, btScalar(0.03));
  scene.world->rayTest(hit.m_rayFromWorld, hit.m_rayToWorld, hit);
  ASSERT_TRUE(hit.hasHit());
  const PhysicalModel model = scene.simulation.model(1);
  ASSERT_GE(hit.triangle, 0);
  ASSERT_LT(static_cast<std::size_t>(hit.triangle), model.geometry.faces.size());
  const Face& face = model.geometry.faces[FaceId(static_cast<std::size_t>(hit.triangle))];
  for (PointId p : face.corners) EXPECT_NEAR(model.geometry.points[p].y(), 0.15, 1e-12);
}

TEST(Query, SweepStopsAtALattice) {
  Scene scene;
  btSphereShape ball(btScalar(0.1));
  btTransform from(btQuaternion::getIdentity(), btVector3(0, 2, 0));
  btTransform to(btQuaternion::getIdentity(), btVector3(0, -2, 0));
  btCollisionWorld::ClosestConvexResultCallback hit(from.getOrigin(), to.getOrigin());
  scene.world->convexSweepTest(&ball, from, to, hit);
  ASSERT_TRUE(hit.hasHit());
  EXPECT_EQ(hit.m_hitCollisionObject, &scene.body());
  // Bullet's own convex cast ends within a thousandth of the way.
  EXPECT_NEAR(2.0 - 4.0 * hit.m_closestHitFraction, 0.25, 4e-3);
}

struct Contacts : btCollisionWorld::ContactResultCallback {
  std::set<const btCollisionObject*> objects;
  btScalar deepest = 0;
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int, int,
                           const btCollisionObjectWrapper* b, int, int) override {
    objects.insert(a->getCollisionObject());
    objects.insert(b->getCollisionObject());
    deepest = std::min(deepest, point.getDistance());
    return 0;
  }
};

TEST(Query, ContactTestFindsALattice) {
  Scene scene;
  btSphereShape shape(btScalar(0.1));
  btCollisionObject ball;
  ball.setCollisionShape(&shape);
  for (double height : {0.24, 0.28}) {  // 1 cm in, 3 cm off
    ball.setWorldTransform(btTransform(
        btQuaternion::getIdentity(), btVector3(btScalar(0.02), btScalar(height), btScalar(0.03))));
    Contacts found, pair;
    scene.world->contactTest(&ball, found);
    scene.world->contactPairTest(&ball, &scene.body(), pair);
    EXPECT_EQ(found.objects.contains(&scene.body()), height < 0.25);
    EXPECT_EQ(pair.objects.contains(&scene.body()), height < 0.25);
    EXPECT_NEAR(found.deepest, height < 0.25 ? -0.01 : 0.0, 1e-4);
  }
}

// btDefaultVehicleRaycaster takes only rigid bodies that respond to contact.
TEST(Query, WheelStandsOnALattice) {
  Scene scene;
  btDefaultVehicleRaycaster raycaster(&*scene.world);
  btVehicleRaycaster::btVehicleRaycasterResult result;
  EXPECT_EQ(raycaster.castRay(btVector3(0, 1, 0), btVector3(0, -1, 0), result), &scene.body());
  EXPECT_NEAR(result.m_distFraction, 0.425, precision());
}

// Its box overlaps what lies near it, but contact is the lattice's own.
TEST(Query, LatticeLeavesBulletNoContactToSolve) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block({.modulus = 1e6}, {0.0, 0.2, 0.0}));
  btRigidBody& box = world.add_box({0.1, 0.1, 0.1}, 1.0, {0.23, 0.1, 0.0});
  box.setFriction(0);
  for (int tick = 0; tick < 60; ++tick) {
    world.step(kTick);
    const btCollisionObject* body = simulation.pieces().at(0).body;
    for (int m = 0; m < world->getDispatcher()->getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *world->getDispatcher()->getManifoldByIndexInternal(m);
      EXPECT_TRUE(manifold.getBody0() != body && manifold.getBody1() != body);
    }
  }
  EXPECT_GT(box.getWorldTransform().getOrigin().x(), 0.23);  // the lattice pushed it aside
}

// Bullet merges, and wakes, islands whose boxes overlap; that of a lattice is none of them.
TEST(Query, LatticeLetsWhatLiesInItsBoxSleep) {
  World world;
  world.add_ground();
  // An arch over the sleeper: its box holds it, its material does not.
  PhysicalModel arch = make_block({.cells = {10, 1, 1}, .modulus = 1e7}, {0.0, 0.45, 0.0});
  for (PointId p : ids_of(arch.points)) {
    Vec3& x = arch.geometry.points[p];
    x.y() += 0.2 - 2.0 * x.x() * x.x();
    arch.points[p].pinned = std::abs(x.x()) > 0.49;
  }
  for (EdgeId e : ids_of(arch.edges)) {  // unstrained as it is
    const auto [a, b] = arch.geometry.edges[e];
    arch.edges[e].rest_length = (arch.geometry.points[a] - arch.geometry.points[b]).norm();
  }
  CoSimulation simulation(*world);
  simulation.add(arch);
  btRigidBody& box = world.add_box({0.1, 0.1, 0.1}, 1.0, {0.0, 0.1, 0.0});
  world.run(4.0, kTick);
  EXPECT_TRUE(simulation.pieces().at(0).flexible);
  EXPECT_FALSE(box.isActive());
  btVector3 low, high;
  simulation.pieces().at(0).body->getAabb(low, high);
  EXPECT_LT(low.y(), box.getWorldTransform().getOrigin().y() + btScalar(0.1));
}

struct Lines : btIDebugDraw {
  std::vector<std::pair<Vec3, Vec3>> lines;
  void drawLine(const btVector3& a, const btVector3& b, const btVector3&) override {
    lines.emplace_back(from_bullet(a), from_bullet(b));
  }
  void drawContactPoint(const btVector3&, const btVector3&, btScalar, int,
                        const btVector3&) override {}
  void reportErrorWarning(const char*) override {}
  void draw3dText(const btVector3&, const char*) override {}
  void setDebugMode(int) override {}
  int getDebugMode() const override { return DBG_DrawWireframe; }
};

TEST(Query, DebugDrawerGetsTheSurfaceOfALattice) {
  Scene scene(make_block({.modulus = 1e6}, Vec3::Zero(), {1.0, 0.0, 0.0}));
  scene.world.run(0.5, kTick);
  Lines drawer;
  scene.world->setDebugDrawer(&drawer);
  scene.world->debugDrawObject(scene.body().getWorldTransform(), scene.body().getCollisionShape(),
                               btVector3(1, 1, 1));
  scene.world->setDebugDrawer(nullptr);
  const PhysicalModel model = scene.simulation.model(0);
  const auto is_point = [&](const Vec3& place) {
    return std::any_of(model.geometry.points.begin(), model.geometry.points.end(),
                       [&](const Vec3& x) { return (x - place).norm() < precision(); });
  };
  std::size_t sides = 0;
  for (const auto& [a, b] : drawer.lines) sides += is_point(a) && is_point(b) ? 1 : 0;
  // 6 sides of 3 x 3 squares of two triangles, three lines each.
  EXPECT_EQ(sides, 6u * 9u * 2u * 3u);
}

// A piece keeps its body, and with it what a game hung on it, through changes of representation.
TEST(Body, OfAPieceStaysWhatItIsThroughSwitching) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world);
  simulation.add(make_block({.modulus = 1e6, .internal_damping = 100.0}, {0.0, 0.5, 0.0}));
  btRigidBody* const body = simulation.pieces().at(0).body;
  ASSERT_FALSE(simulation.pieces().at(0).flexible);
  int mine = 0;
  body->setUserPointer(&mine);
  body->setFriction(btScalar(0.123));
  world->removeRigidBody(body);
  world->addRigidBody(body, 64, -1);
  bool was_flexible = false;
  for (int tick = 0; tick < 240; ++tick) {
    world.step(kTick);
    const PieceView piece = simulation.pieces().at(0);
    was_flexible = was_flexible || piece.flexible;
    ASSERT_EQ(piece.body, body);
    ASSERT_LT((from_bullet(body->getCenterOfMassPosition()) - piece.motion.centre).norm(), 1e-5);
    ASSERT_LT((from_bullet(body->getLinearVelocity()) - piece.motion.velocity).norm(), 1e-5);
  }
  EXPECT_TRUE(was_flexible);
  EXPECT_FALSE(simulation.pieces().at(0).flexible);
  EXPECT_EQ(body->getUserPointer(), &mine);
  EXPECT_EQ(body->getBroadphaseHandle()->m_collisionFilterGroup, 64);
  EXPECT_FLOAT_EQ(static_cast<float>(body->getFriction()), 0.123f);
  EXPECT_TRUE(body->hasContactResponse());
  EXPECT_FALSE(body->isStaticOrKinematicObject());
}

}  // namespace
}  // namespace limber::bullet::test
