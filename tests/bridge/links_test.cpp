#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Links of multi-bodies, and kinematic bodies: lattices meet them as they move, and push nothing.

namespace limber::bullet::test {
namespace {

enum class Joint { kFixed, kHingeY, kSliderX };

// A box on one joint of a fixed base at the origin, which nothing slows.
class LinkWorld {
 public:
  LinkWorld(Joint joint, const Vec3& half, const Vec3& centre, double gravity)
      : shape_(to_bullet(half)), body_(1, 0, btVector3(0, 0, 0), true, false) {
    world_.setGravity(to_bullet(Vec3(0.0, -gravity, 0.0)));
    const btVector3 inertia(1, 1, 1), to_link = to_bullet(centre), none(0, 0, 0);
    const btQuaternion unturned = btQuaternion::getIdentity();
    if (joint == Joint::kFixed) body_.setupFixed(0, 1, inertia, -1, unturned, none, to_link);
    if (joint == Joint::kHingeY) {
      body_.setupRevolute(0, 1, inertia, -1, unturned, btVector3(0, 1, 0), none, to_link);
    }
    if (joint == Joint::kSliderX) {
      body_.setupPrismatic(0, 1, inertia, -1, unturned, btVector3(1, 0, 0), none, to_link, false);
    }
    body_.finalizeMultiDof();
    body_.setLinearDamping(0);
    body_.setAngularDamping(0);
    body_.setCanSleep(false);
    world_.addMultiBody(&body_);
    link_.setCollisionShape(&shape_);
    body_.getLink(0).m_collider = &link_;
    world_.addCollisionObject(&link_);
    place();
  }
  ~LinkWorld() {
    world_.removeCollisionObject(&link_);
    world_.removeMultiBody(&body_);
  }
  LinkWorld(const LinkWorld&) = delete;
  LinkWorld& operator=(const LinkWorld&) = delete;

  void set_joint(double position, double velocity) {
    body_.setJointPos(0, static_cast<btScalar>(position));
    body_.setJointVel(0, static_cast<btScalar>(velocity));
    place();
  }
  double joint_velocity() const { return body_.getJointVel(0); }
  Vec3 link_centre() const { return from_bullet(link_.getWorldTransform().getOrigin()); }
  btMultiBodyDynamicsWorld& operator*() { return world_; }
  void step(double tick = kTick) {
    world_.stepSimulation(static_cast<btScalar>(tick), 1, static_cast<btScalar>(tick));
  }

 private:
  void place() {
    btAlignedObjectArray<btQuaternion> turns;
    btAlignedObjectArray<btVector3> origins;
    body_.forwardKinematics(turns, origins);
    body_.updateCollisionObjectWorldTransforms(turns, origins);
    world_.updateSingleAabb(&link_);
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btBoxShape shape_;
  btMultiBody body_;
  btMultiBodyLinkCollider link_{&body_, 0};
};

const Block kBlock{.mass = 8.0, .modulus = 1e6, .damping_ratio = 0.1, .internal_damping = 20.0};
constexpr double kHalf = 0.15;  // m, of the block

// m: where the lowest point of a block comes to rest on a static box whose top is at y = 0.2.
double resting_height(Representation kind) {
  World world;
  world.add_box({0.5, 0.1, 0.5}, 0.0, {0.0, 0.1, 0.0});
  CoSimulation simulation(*world, settings_for(kind));
  simulation.add(make_block(kBlock, {0.0, 0.2 + kHalf + 0.05, 0.0}));
  world.run(3.0, kTick);
  return lowest_point(simulation.model(0));
}

TEST(Link, CarriesALatticeAsAStaticBoxDoes) {
  for (const Representation kind : {Representation::kAlwaysFlexible, Representation::kSwitching}) {
    LinkWorld world(Joint::kFixed, {0.5, 0.1, 0.5}, {0.0, 0.1, 0.0}, kGravity);
    // The link touches it, which is no support of anything that moves.
    btStaticPlaneShape floor(btVector3(0, 1, 0), 0);
    btRigidBody ground(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &floor));
    (*world).addRigidBody(&ground);
    {
      CoSimulation simulation(*world, settings_for(kind));
      simulation.add(make_block(kBlock, {0.0, 0.2 + kHalf + 0.05, 0.0}));
      for (int tick = 0; tick < 180; ++tick) world.step();
      ASSERT_FALSE(simulation.failure());
      const PhysicalModel now = simulation.model(0);
      const bool flexible = kind == Representation::kAlwaysFlexible;
      // A proxy is Bullet's own business, whose solvers differ by 15 um here.
      EXPECT_NEAR(lowest_point(now), resting_height(kind), flexible ? 1e-6 : 1e-4);
      EXPECT_NEAR(lowest_point(now), 0.2, 0.006);  // soft: 4 mm
      EXPECT_LT(sums_of(now).velocity().norm(), 1e-3);
    }
    (*world).removeRigidBody(&ground);
  }
}

// A slider at constant speed V works F V: the momentum it has given times V is the energy that the
// block may have at most. None of it comes back to the link, which counts as kinematic.
TEST(Link, GivesALatticeNoMoreThanTheWorkOfItsForce) {
  for (const double speed : {0.5, 3.0, 20.0}) {
    for (const double restitution : {0.0, 1.0}) {
      LinkWorld world(Joint::kSliderX, {0.02, 0.5, 0.5}, Vec3::Zero(), 0.0);
      Block block = kBlock;
      block.internal_damping = 0.0;
      block.restitution = restitution;
      CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
      simulation.add(make_block(block, {0.5, 0.0, 0.0}));
      world.set_joint(0.0, speed);
      for (double t = 0.0; t < 1.0 / speed; t += kTick) world.step();
      ASSERT_FALSE(simulation.failure());
      const Sums sums = sums_of(simulation.model(0));
      EXPECT_NEAR(world.joint_velocity(), speed, 1e-5 * speed);
      // Between inelastic and elastic; what swings inside has its share.
      EXPECT_GT(sums.velocity().x(), 0.9 * speed) << speed;
      EXPECT_LT(sums.velocity().x(), 2.0 * speed) << speed;
      const double work = sums.momentum.x() * speed;
      EXPECT_LT(sums.energy(0.0), work * (1.0 + by_precision(1e-5, 1e-9))) << speed;
      EXPECT_GT(sums.energy(0.0), 0.45 * work) << speed;
    }
  }
}

TEST(Link, SwingsALatticeAway) {
  constexpr double kArm = 1.0, kSpin = 5.0;  // m, rad/s
  LinkWorld world(Joint::kHingeY, {0.3, 0.3, 0.05}, {kArm, 0.0, 0.0}, 0.0);
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block(kBlock, {kArm, 0.0, -0.4}));
  world.set_joint(0.0, kSpin);  // about y: towards -z
  for (int tick = 0; tick < 30; ++tick) world.step();
  ASSERT_FALSE(simulation.failure());
  const Sums sums = sums_of(simulation.model(0));
  EXPECT_LT(sums.velocity().z(), -0.8 * kArm * kSpin);
  EXPECT_LT(sums.velocity().norm(), 2.0 * kArm * kSpin);
  // A hinge at constant speed works its torque times that.
  const double work = sums.angular_momentum.y() * kSpin;
  EXPECT_LT(sums.energy(0.0), 1.02 * work);  // a link goes straight within a tick
}

// Bullet's own boxes of links and kinematic bodies do not include their way in the tick.
TEST(Link, IsForeseenByWhatItHits) {
  LinkWorld world(Joint::kSliderX, {0.02, 0.5, 0.5}, Vec3::Zero(), 0.0);
  CoSimulation simulation(*world);
  simulation.add(make_block(kBlock, {0.5, 0.0, 0.0}));
  world.set_joint(0.0, 20.0);
  for (int tick = 0; tick < 2; ++tick) world.step();
  ASSERT_EQ(simulation.switches().size(), 2u);
  EXPECT_EQ(simulation.switches()[1].cause, "touch");
  EXPECT_EQ(simulation.counters().missed, 0u);
  // What it has not reached it has not moved.
  EXPECT_GT(simulation.switches()[1].time, 0.33 / 20.0 - 1.5 * kTick);
  for (int tick = 0; tick < 10; ++tick) {
    world.step();
    const PhysicalModel now = simulation.model(0);
    double rear = 1e9;
    for (const Vec3& x : now.geometry.points) rear = std::min(rear, x.x());
    EXPECT_GT(rear, world.link_centre().x()) << tick;
  }
}

TEST(Kinematic, FastBodyDoesNotStepIntoALattice) {
  World world(0.0);
  btRigidBody& wall = world.add_box({0.02, 0.5, 0.5}, 0.0, {-0.5, 0.0, 0.0});
  wall.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  wall.setActivationState(DISABLE_DEACTIVATION);
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block(kBlock, Vec3::Zero()));
  constexpr double kSpeed = 12.0;  // m/s: 20 cm a tick
  for (int tick = 1; tick <= 6; ++tick) {
    btTransform pose = wall.getWorldTransform();
    pose.setOrigin(to_bullet(Vec3(-0.5 + kSpeed * tick * kTick, 0.0, 0.0)));
    wall.setWorldTransform(pose);
    world.step(kTick);
  }
  ASSERT_FALSE(simulation.failure());
  const Sums sums = sums_of(simulation.model(0));
  EXPECT_GT(sums.velocity().x(), 0.9 * kSpeed);
  EXPECT_LT(sums.energy(0.0), sums.momentum.x() * kSpeed * (1.0 + by_precision(1e-5, 1e-9)));
}

}  // namespace
}  // namespace limber::bullet::test
