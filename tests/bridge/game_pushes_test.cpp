#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// What a game does to a piece's body reaches the piece, whatever its representation is then and in
// the tick that follows.

namespace limber::bullet::test {
namespace {

const Vec3 kImpulse(4.0, -2.0, 6.0);  // N s
const Vec3 kArm(0.05, 0.1, -0.1);     // m, from the centre
constexpr double kMass = 8.0;

// A soft block of 8 kg in a world without gravity.
struct Scene {
  World world{0.0};
  CoSimulation simulation;

  explicit Scene(Representation as, const Vec3& centre = Vec3::Zero())
      : simulation(*world, settings_for(as)) {
    simulation.add(make_block({.modulus = 1e6}, centre));
  }
  btRigidBody& body() { return *simulation.pieces().at(0).body; }
  Sums sums() { return sums_of(simulation.model(0)); }
};

double rounding() { return by_precision(1e-5, 1e-12); }

class Push : public testing::TestWithParam<Representation> {};

TEST_P(Push, ByAnImpulseGivesItsMomentum) {
  Scene scene(GetParam());
  scene.body().applyImpulse(to_bullet(kImpulse), to_bullet(kArm));
  scene.world.step(kTick);
  EXPECT_LT((scene.sums().momentum - kImpulse).norm(), rounding());
  EXPECT_LT((scene.sums().angular_momentum - kArm.cross(kImpulse)).norm(), rounding());
}

TEST_P(Push, ByAForceGivesItsMomentumInEveryTick) {
  Scene scene(GetParam());
  for (int tick = 0; tick < 6; ++tick) {
    scene.body().applyForce(to_bullet(60.0 * kImpulse), btVector3(0, 0, 0));
    scene.world.step(kTick);
  }
  EXPECT_LT((scene.sums().momentum - 6.0 * kImpulse).norm(), 10.0 * rounding());
}

// Bullet keeps a force for all ticks of a call.
TEST_P(Push, ByAForceLastsForAllTicksOfACall) {
  Scene scene(GetParam());
  scene.body().applyCentralForce(to_bullet(60.0 * kImpulse));
  scene.world->stepSimulation(btScalar(3.5 * kTick), 10, btScalar(kTick));
  EXPECT_LT((scene.sums().momentum - 3.0 * kImpulse).norm(), 10.0 * rounding());
  scene.world->stepSimulation(btScalar(kTick), 10, btScalar(kTick));
  EXPECT_LT((scene.sums().momentum - 3.0 * kImpulse).norm(), 10.0 * rounding());
}

TEST_P(Push, BySettingVelocitiesSetsThem) {
  Scene scene(GetParam());
  scene.body().setLinearVelocity(btVector3(1, 2, 3));
  scene.body().setAngularVelocity(btVector3(0, 2, 0));
  scene.world.step(kTick);
  const RigidMotion motion = scene.simulation.pieces().at(0).motion;
  EXPECT_LT((motion.velocity - Vec3(1, 2, 3)).norm(), rounding());
  // A block that spins is drawn out by v^2 / c^2 = (0.4 m/s / 11 m/s)^2 = 0.001.
  EXPECT_LT((motion.angular_velocity - Vec3(0, 2, 0)).norm(), 2e-3);
}

TEST_P(Push, ByATeleportMovesAndTurnsIt) {
  Scene scene(GetParam());
  scene.body().setLinearVelocity(btVector3(1, 0, 0));
  scene.world.step(kTick);
  const PhysicalModel before = scene.simulation.model(0);
  const Vec3 centre = scene.sums().centre();
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  btTransform pose = scene.body().getCenterOfMassTransform();
  pose.setOrigin(btVector3(5, 6, 7));
  pose.setRotation(to_bullet(turn * from_bullet(pose.getRotation())));
  scene.body().setCenterOfMassTransform(pose);
  scene.world.step(kTick);
  const PhysicalModel after = scene.simulation.model(0);
  const Vec3 expected = Vec3(5, 6, 7) + kTick * Vec3::UnitX();
  for (PointId p : ids_of(after.points)) {
    const Vec3 arm = turn * (before.geometry.points[p] - centre);
    EXPECT_LT((after.geometry.points[p] - expected - arm).norm(), by_precision(5e-6, 1e-12));
  }
}

// Nothing was on the way from where it was to where it is put.
TEST_P(Push, ByATeleportThroughAWallMeetsNoWall) {
  Scene scene(GetParam());
  scene.world.add_box({0.1, 5.0, 5.0}, 0.0, {1.0, 0.0, 0.0});
  scene.world.step(kTick);
  btTransform pose = scene.body().getCenterOfMassTransform();
  pose.setOrigin(btVector3(btScalar(1.3), 0, 0));
  scene.body().setCenterOfMassTransform(pose);
  for (int tick = 0; tick < 10; ++tick) scene.world.step(kTick);
  EXPECT_LT((scene.sums().centre() - Vec3(1.3, 0.0, 0.0)).norm(), 1e-6);
}

TEST_P(Push, AtAPlaceGivesItsMomentum) {
  Scene scene(GetParam(), {1.0, 2.0, 3.0});
  const Vec3 at = Vec3(1.0, 2.0, 3.0) + kArm;
  const Vec3 small = 0.01 * kImpulse;  // within a tick the block hardly turns
  scene.simulation.apply_impulse(0, small, at);
  scene.world.step(kTick);
  EXPECT_LT((scene.sums().momentum - small).norm(), rounding());
  // Forces keep their size while the points that bear them move: by 0.01 of the arm.
  EXPECT_LT((scene.sums().angular_momentum - at.cross(small)).norm(),
            0.02 * at.cross(small).norm());
}

TEST_P(Push, AtAPlaceIsRefusedIfItIsNone) {
  Scene scene(GetParam());
  const Vec3 nowhere(std::nan(""), 0.0, 0.0);
  EXPECT_THROW(scene.simulation.apply_impulse(1, kImpulse, Vec3::Zero()), InputError);
  EXPECT_THROW(scene.simulation.apply_impulse(0, kImpulse, nowhere), InputError);
  EXPECT_THROW(scene.simulation.apply_impulse(0, nowhere, Vec3::Zero()), InputError);
}

TEST_P(Push, GivesAMotionStateItsPose) {
  Scene scene(GetParam());
  btDefaultMotionState state;
  scene.body().setMotionState(&state);
  scene.body().setLinearVelocity(btVector3(1, 2, 3));
  for (int tick = 0; tick < 10; ++tick) scene.world.step(kTick);
  btTransform pose;
  state.getWorldTransform(pose);
  // Bullet's interpolation is a tick late for what it moves itself.
  EXPECT_LT((from_bullet(pose.getOrigin()) - scene.sums().centre()).norm(),
            1.01 * kTick * Vec3(1, 2, 3).norm());
  EXPECT_GT(from_bullet(pose.getOrigin()).norm(), 0.4);
  scene.body().setMotionState(nullptr);
}

// A game that draws more often than Bullet steps gets places between ticks, a tick late as Bullet
// has it, on the parabola but for g dt^2 / 2 of straight line.
TEST_P(Push, GivesAFlyingPiecesMotionStatePlacesBetweenTicks) {
  World world;
  CoSimulation simulation(*world, settings_for(GetParam()));
  simulation.add(make_block({}, Vec3::Zero(), {2.0, 3.0, 0.0}));
  btDefaultMotionState state;
  btRigidBody& body = *simulation.pieces().at(0).body;
  body.setMotionState(&state);
  const double frame = 1.0 / 144.0;
  double last = -1.0;
  for (int i = 1; i <= 72; ++i) {
    world->stepSimulation(btScalar(frame), 10, btScalar(kTick));
    const double t = i * frame - kTick;
    if (t < kTick) continue;
    btTransform pose;
    state.getWorldTransform(pose);
    const Vec3 expected(2.0 * t, 3.0 * t - 0.5 * kGravity * t * t, 0.0);
    EXPECT_LT((from_bullet(pose.getOrigin()) - expected).norm(),
              0.5 * kGravity * kTick * kTick + 1e-4);
    EXPECT_GT(pose.getOrigin().x(), last + 1e-3);  // every frame shows it farther
    last = pose.getOrigin().x();
  }
  body.setMotionState(nullptr);
}

INSTANTIATE_TEST_SUITE_P(InAnyRepresentation, Push,
                         testing::Values(Representation::kAlwaysRigid,
                                         Representation::kAlwaysFlexible));

// The game pushes a proxy in the same frame in which a touch makes it flexible.

// 12 m/s for a sixtieth of a second are 0.2 m; the wall is 0.15 m away.
TEST(PushAtTheChange, VelocityMakesItTouchAndIsKept) {
  World world(0.0);
  CoSimulation simulation(*world);
  world.add_box({0.1, 5.0, 5.0}, 0.0, {0.4, 0.0, 0.0});
  simulation.add(make_block({.modulus = 1e6}, Vec3::Zero()));
  ASSERT_FALSE(simulation.pieces().at(0).flexible);
  simulation.pieces().at(0).body->setLinearVelocity(btVector3(12, 0, 0));
  world.step(kTick);
  ASSERT_TRUE(simulation.pieces().at(0).flexible);
  const Sums sums = sums_of(simulation.model(0));
  EXPECT_LT(sums.momentum.x(), 0.98 * kMass * 12.0);  // the wall has begun to stop it
  EXPECT_GT(sums.centre().x(), 0.15);                 // where it came to with that speed
}

// Flexible because another lattice comes near, and pushed by the game in that very tick, across.
TEST(PushAtTheChange, ForceImpulseAndTeleportAreExact) {
  World world(0.0);
  CoSimulation simulation(*world);
  simulation.add(make_block({.modulus = 1e6}, Vec3::Zero()));
  simulation.add(make_block({.modulus = 1e6}, {0.32, 5.0, 0.0}, {-4.0, 0.0, 0.0}));
  ASSERT_FALSE(simulation.pieces().at(0).flexible);
  btRigidBody& body = *simulation.pieces().at(0).body;
  btTransform pose = body.getCenterOfMassTransform();
  pose.setOrigin(btVector3(0, 5, 0));
  body.setCenterOfMassTransform(pose);
  body.applyCentralImpulse(to_bullet(kImpulse));
  body.applyCentralForce(to_bullet(60.0 * kImpulse));
  world.step(kTick);
  ASSERT_TRUE(simulation.pieces().at(0).flexible);
  const Sums mine = sums_of(simulation.model(0));
  Sums both = mine;
  both += sums_of(simulation.model(1));
  const Vec3 expected = 2.0 * kImpulse - kMass * 4.0 * Vec3::UnitX();
  EXPECT_LT((both.momentum - expected).norm(), by_precision(1e-4, 1e-11));
  // Contact has no say in where it goes across the other's way, but for friction.
  EXPECT_NEAR(mine.centre().z(), kTick * 2.0 * kImpulse.z() / kMass, 0.005);
  EXPECT_NEAR(mine.centre().y(), 5.0, 0.02);
}

// Bullet has given the tick's gravity when a piece turns flexible; the lattice has its own.
TEST(PushAtTheChange, GravityCountsOnce) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(make_block({.modulus = 1e6}, Vec3::Zero()));
  simulation.add(make_block({.modulus = 1e6}, {0.32, 0.0, 0.0}, {-4.0, 0.0, 0.0}));
  // Three ticks of one call: they turn flexible in the first.
  world->stepSimulation(btScalar(3.5 * kTick), 10, btScalar(kTick));
  ASSERT_EQ(simulation.counters().to_flexible, 2u);
  Sums both = sums_of(simulation.model(0));
  both += sums_of(simulation.model(1));
  EXPECT_NEAR(both.momentum.y(), -2.0 * kMass * kGravity * 3.0 * kTick, by_precision(1e-4, 1e-11));
}

}  // namespace
}  // namespace limber::bullet::test
