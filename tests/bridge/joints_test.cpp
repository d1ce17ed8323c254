#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// A game's constraints on pieces: they hold in either representation, go on through changes, and
// stay with the part that they hold when it breaks.

namespace limber::bullet::test {
namespace {

constexpr double kMass = 8.0;
const Vec3 kTop(0.0, 0.15, 0.0);  // m, of a block about the origin

// A body's place that is at `place` now.
btVector3 local_place(const btRigidBody& body, const Vec3& place) {
  return body.getCenterOfMassTransform().inverse() * to_bullet(place);
}

Vec3 world_place(const btRigidBody& body, const btVector3& local) {
  return from_bullet(body.getCenterOfMassTransform() * local);
}

// A constraint for as long as it lives.
template <class Constraint>
class Joint {
 public:
  template <class... Arguments>
  explicit Joint(World& world, Arguments&&... arguments)
      : world_(world), joint_(std::forward<Arguments>(arguments)...) {
    world_->addConstraint(&joint_);
  }
  ~Joint() { world_->removeConstraint(&joint_); }
  Constraint& operator*() { return joint_; }
  Constraint* operator->() { return &joint_; }

 private:
  World& world_;
  Constraint joint_;
};
using BallJoint = Joint<btPoint2PointConstraint>;

// A block hung from its top's middle by a ball joint, let go at an angle.
struct Pendulum {
  World world;
  CoSimulation simulation;
  btRigidBody* body;
  btVector3 pivot;
  std::unique_ptr<BallJoint> joint;

  explicit Pendulum(Representation as) : simulation(*world, settings_for(as)) {
    PhysicalModel model = make_block({.modulus = 2e6, .internal_damping = 100.0}, {0.0, -0.5, 0.0});
    place(model, Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero());
    simulation.add(model);
    body = simulation.pieces().at(0).body;
    pivot = local_place(*body, Vec3::Zero());
    joint = std::make_unique<BallJoint>(world, *body, pivot);
  }
  double energy() { return sums_of(simulation.model(0)).energy(kGravity); }
  double drift() { return world_place(*body, (*joint)->getPivotInA()).norm(); }
};

class JointInAnyRepresentation : public testing::TestWithParam<Representation> {};

// Period of the physical pendulum of the same mass, arm and moment, 2 pi sqrt(I / (m g d)), times
// 1 + a^2 / 16 for the swing of a = 0.5: the centre is below the pivot after a quarter of it.
TEST_P(JointInAnyRepresentation, MakesAPendulum) {
  Pendulum pendulum(GetParam());
  const Sums start = sums_of(pendulum.simulation.model(0));
  const RigidMotion motion = pendulum.simulation.pieces().at(0).motion;
  const double inertia = motion.inertia(2, 2) + kMass * 0.25;
  const double period =
      2.0 * M_PI * std::sqrt(inertia / (kMass * kGravity * 0.5)) * (1.0 + 0.25 / 16.0);
  const double energy = pendulum.energy();
  double crossed = 0.0, highest = energy, widest = 0.0;
  for (int tick = 1; tick <= 120; ++tick) {
    const double before = pendulum.simulation.pieces().at(0).motion.centre.x();
    pendulum.world.step(kTick);
    const double after = pendulum.simulation.pieces().at(0).motion.centre.x();
    if (crossed == 0.0 && before > 0.0 && after <= 0.0) {
      crossed = (tick - after / (after - before)) * kTick;
    }
    highest = std::max(highest, pendulum.energy());
    widest = std::max(widest, pendulum.drift());
  }
  EXPECT_FALSE(pendulum.simulation.failure());
  EXPECT_GT(start.centre().x(), 0.2);
  // Bullet's own error is a tick of its joints.
  EXPECT_NEAR(crossed, 0.25 * period, kTick);
  EXPECT_LT(widest, 0.005);  // m: Bullet's own drift is 2 mm
  // Bullet's joints err by a part of the 4.8 J that the fall to the lowest point gives.
  EXPECT_LT(highest - energy, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Pieces, JointInAnyRepresentation,
                         testing::Values(Representation::kAlwaysRigid,
                                         Representation::kAlwaysFlexible));

// The lattice and a body on one joint: what one gets the other loses.
TEST(Joint, BetweenALatticeAndABodyKeepsMomentum) {
  World world(0.0);
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block({.modulus = 1e6}, Vec3::Zero(), {1.0, 0.0, 0.0}, {0.0, 0.0, 2.0}));
  btRigidBody& box = world.add_box({0.1, 0.1, 0.1}, 2.0, {0.0, 0.4, 0.0});
  box.setFlags(0);
  btRigidBody& lattice = *simulation.pieces().at(0).body;
  BallJoint joint(world, lattice, box, local_place(lattice, {0.0, 0.25, 0.0}),
                  btVector3(0, btScalar(-0.15), 0));
  Sums before = sums_of(simulation.model(0));
  before += sums_of(box);
  world.run(2.0, kTick);
  Sums after = sums_of(simulation.model(0));
  after += sums_of(box);
  EXPECT_GT(sums_of(box).momentum.norm(), 0.1);
  EXPECT_LT((after.momentum - before.momentum).norm(), by_precision(1e-3, 1e-11));
  EXPECT_LT(after.kinetic + after.elastic, 1.05 * before.kinetic);
}

// A load on a joint strains the lattice around it: as much as the same weight hung on its points.
TEST(Joint, StrainsTheLatticeWhereItHolds) {
  World world;
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysFlexible));
  simulation.add(make_block({.modulus = 1e5, .internal_damping = 50.0}, Vec3::Zero()));
  btRigidBody& body = *simulation.pieces().at(0).body;
  BallJoint joint(world, body, local_place(body, kTop));
  world.run(2.0, kTick);
  const PhysicalModel model = simulation.model(0);
  double high = -1.0, low = 1.0;
  for (const Vec3& x : model.geometry.points) {
    high = std::max(high, x.y());
    low = std::min(low, x.y());
  }
  // Hung from one side a bar stretches by rho g L^2 / (2 E) = 1.2 mm; from a point by more.
  EXPECT_GT(high - low, 0.3 + 1e-3);
  EXPECT_LT(high - low, 0.3 + 2e-2);
}

// A weight hung from the middle of a bar that pins hold at its ends: it comes to rest there.
TEST(Joint, OnAPinnedLatticeBearsAWeight) {
  World world;
  CoSimulation simulation(*world);
  PhysicalModel model = make_block(
      {.cells = {10, 1, 1}, .mass = 8.0, .modulus = 1e7, .internal_damping = 20.0}, Vec3::Zero());
  for (PointId p : ids_of(model.points)) {
    if (std::abs(model.geometry.points[p].x()) > 0.49) model.points[p].pinned = true;
  }
  simulation.add(model);
  btRigidBody& bar = *simulation.pieces().at(0).body;
  btRigidBody& weight = world.add_box({0.1, 0.1, 0.1}, 2.0, {0.0, -0.25, 0.0});
  weight.setDamping(btScalar(0.5), btScalar(0.5));
  BallJoint joint(world, bar, weight, local_place(bar, {0.0, -0.05, 0.0}),
                  btVector3(0, btScalar(0.2), 0));
  world.run(6.0, kTick);
  ASSERT_FALSE(simulation.failure());
  EXPECT_LT(weight.getLinearVelocity().length(), 0.01);
  // (w L / 384 + W / 192) L^3 / (E I) = 4 mm, less by what so coarse a bar is too stiff.
  EXPECT_NEAR(weight.getCenterOfMassPosition().y(), -0.25, 0.01);
}

// A weight hung below it pulls a block against the joint above: F L / (m c^2) = F / (E A) with
// E A = 90 kN. Both joints pull, with next to no force on the whole.
TEST(Joint, ThatPullsTooHardTurnsAProxyFlexible) {
  for (const double mass : {5.0, 200.0}) {  // 0.05 % and 2 %; the limit is 1 %
    World world;
    CoSimulation simulation(*world);
    simulation.add(make_block({.modulus = 1e6, .internal_damping = 100.0}, -kTop));
    btRigidBody& body = *simulation.pieces().at(0).body;
    BallJoint above(world, body, local_place(body, Vec3::Zero()));
    btRigidBody& weight = world.add_box({0.1, 0.1, 0.1}, mass, {0.0, -0.4, 0.0});
    BallJoint below(world, body, weight, local_place(body, -2.0 * kTop),
                    btVector3(0, btScalar(0.1), 0));
    btJointFeedback of_the_game;
    below->setJointFeedback(&of_the_game);
    world.run(0.5, kTick);
    EXPECT_EQ(simulation.counters().to_flexible > 0, mass > 100.0) << mass;
    EXPECT_EQ(below->getJointFeedback(), &of_the_game);
    EXPECT_EQ(above->getJointFeedback(), nullptr);
    if (mass > 100.0) continue;
    EXPECT_NEAR(of_the_game.m_appliedForceBodyA.length(), mass * kGravity, 0.2 * mass * kGravity);
  }
}

// Hit by a ball, it turns flexible, and rigid again later; the joint holds throughout.
TEST(Joint, HoldsThroughSwitching) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(make_block({.modulus = 1e6, .internal_damping = 100.0}, -kTop));
  btRigidBody& body = *simulation.pieces().at(0).body;
  BallJoint joint(world, body, local_place(body, Vec3::Zero()));
  btRigidBody& ball =
      world.add(std::make_unique<btSphereShape>(btScalar(0.05)), 0.5, {1.0, -0.2, 0.0});
  ball.setLinearVelocity(btVector3(-10, 0, 0));
  double widest = 0.0;
  for (int tick = 0; tick < 300; ++tick) {
    world.step(kTick);
    widest = std::max(widest, world_place(body, joint->getPivotInA()).norm());
  }
  EXPECT_GE(simulation.counters().to_flexible, 1u);
  EXPECT_GE(simulation.counters().to_rigid, 2u);  // the start is one
  EXPECT_EQ(simulation.pieces().at(0).body, &body);
  EXPECT_LT(widest, 0.02);
}

// A long bar on a joint at its left end breaks in the middle.
PhysicalModel brittle_bar() {
  PhysicalModel model = make_block(
      {.cells = {10, 1, 1}, .mass = 4.0, .modulus = 1e6, .internal_damping = 50.0}, Vec3::Zero());
  for (EdgeId e : ids_of(model.edges)) {
    const auto [a, b] = model.geometry.edges[e];
    const double x = 0.5 * (model.geometry.points[a].x() + model.geometry.points[b].x());
    if (std::abs(x) < 0.051) model.edges[e].break_threshold = 1e-4;
  }
  return model;
}

TEST(Joint, StaysWithThePartThatItHolds) {
  for (const double end : {-0.5, 0.5}) {
    World world;
    CoSimulation simulation(*world);
    simulation.add(brittle_bar());
    btRigidBody& body = *simulation.pieces().at(0).body;
    BallJoint joint(world, body, local_place(body, {end, 0.0, 0.0}));
    btRigidBody& ball =
        world.add(std::make_unique<btSphereShape>(btScalar(0.05)), 5.0, {0.0, 0.3, 0.0});
    ball.setLinearVelocity(btVector3(0, -10, 0));
    world.run(1.0, kTick);
    ASSERT_FALSE(simulation.failure());
    ASSERT_GE(simulation.pieces().size(), 2u);
    for (const PieceView& piece : simulation.pieces()) {
      if (piece.body == &body) {
        EXPECT_LT((piece.motion.centre - Vec3(end, 0.0, 0.0)).norm(), 0.35);
      } else {
        EXPECT_LT(piece.motion.centre.y(), -1.0);  // it fell
      }
    }
    EXPECT_TRUE(joint->isEnabled());
    EXPECT_LT((world_place(body, joint->getPivotInA()) - Vec3(end, 0.0, 0.0)).norm(), 0.05);
  }
}

// Held at both ends, one of the joints loses its part: a constraint cannot change its bodies.
TEST(Joint, ThatLosesItsPartIsDisabledAndSaidSo) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(brittle_bar());
  btRigidBody& body = *simulation.pieces().at(0).body;
  BallJoint left(world, body, local_place(body, {-0.5, 0.0, 0.0}));
  BallJoint right(world, body, local_place(body, {0.5, 0.0, 0.0}));
  btRigidBody& ball =
      world.add(std::make_unique<btSphereShape>(btScalar(0.05)), 5.0, {0.0, 0.3, 0.0});
  ball.setLinearVelocity(btVector3(0, -10, 0));
  world.run(1.0, kTick);
  EXPECT_TRUE(left->isEnabled());
  EXPECT_FALSE(right->isEnabled());
  ASSERT_EQ(simulation.notes().size(), 1u);
  EXPECT_NE(simulation.notes()[0].what.find("constraint"), std::string::npos);
}

// A flexible block hangs from a static body. A joint is solved by velocities: its ends may part by
// a tick's fall.
TEST_P(JointInAnyRepresentation, AnchorsToAStaticBody) {
  World world;
  btRigidBody& post = world.add_box(Vec3::Constant(0.05), 0.0, {0.0, 0.3, 0.0});
  CoSimulation simulation(*world, settings_for(GetParam()));
  simulation.add(make_block({.modulus = 2e6, .internal_damping = 100.0}, Vec3::Zero()));
  btRigidBody& body = *simulation.pieces().at(0).body;
  const btVector3 pivot = local_place(body, {0.05, 0.15, 0.0});  // it swings a little
  BallJoint joint(world, body, post, pivot, local_place(post, {0.05, 0.15, 0.0}));
  const double start = sums_of(simulation.model(0)).energy(kGravity);
  for (int tick = 0; tick < 180; ++tick) {
    world.step(kTick);
    EXPECT_LT((world_place(body, joint->getPivotInA()) - Vec3(0.05, 0.15, 0.0)).norm(),
              kGravity * kTick * kTick);
    EXPECT_LT(sums_of(simulation.model(0)).energy(kGravity),
              start + 0.02 * kMass * kGravity * 0.05);
  }
  ASSERT_FALSE(simulation.failure());
  EXPECT_EQ(post.getWorldTransform().getOrigin().y(), btScalar(0.3));
}

// And from a kinematic one that rises. Bullet puts that where it will be at the tick's end before
// it solves: what is joined to it runs ahead by a tick's way.
TEST_P(JointInAnyRepresentation, AnchorsToAKinematicBody) {
  constexpr double kSpeed = 0.5;  // m/s
  World world;
  btRigidBody& lift = world.add_box(Vec3::Constant(0.05), 0.0, {0.0, 0.3, 0.0});
  lift.setCollisionFlags(lift.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  lift.setActivationState(DISABLE_DEACTIVATION);
  btDefaultMotionState state(lift.getWorldTransform());
  lift.setMotionState(&state);
  CoSimulation simulation(*world, settings_for(GetParam()));
  simulation.add(
      make_block({.modulus = 2e6, .internal_damping = 100.0}, Vec3::Zero(), {0.0, kSpeed, 0.0}));
  btRigidBody& body = *simulation.pieces().at(0).body;
  BallJoint joint(world, body, lift, local_place(body, kTop), local_place(lift, kTop));
  for (int tick = 1; tick <= 180; ++tick) {
    btTransform pose = btTransform::getIdentity();
    pose.setOrigin(to_bullet(Vec3(0.0, 0.3 + kSpeed * tick * kTick, 0.0)));
    state.setWorldTransform(pose);
    world.step(kTick);
    const Vec3 held = from_bullet(pose * joint->getPivotInB());
    EXPECT_LT((world_place(body, joint->getPivotInA()) - held).norm(), kSpeed * kTick + 1e-3)
        << tick;
  }
  ASSERT_FALSE(simulation.failure());
  const RigidMotion motion = simulation.pieces().at(0).motion;
  EXPECT_NEAR(motion.velocity.y(), kSpeed, 0.01);
  lift.setMotionState(nullptr);
}

// A sleeping box that a flying block is tied to wakes and gets its share.
TEST_P(JointInAnyRepresentation, AnchorsToASleepingBody) {
  World world(0.0);
  btRigidBody& box = world.add_box(Vec3::Constant(0.15), 5.0, {0.0, 0.5, 0.0});
  world.run(3.0, kTick);
  ASSERT_FALSE(box.isActive());
  CoSimulation simulation(*world, settings_for(GetParam()));
  simulation.add(
      make_block({.modulus = 2e6, .internal_damping = 100.0}, Vec3::Zero(), {0.5, -0.2, 0.0}));
  btRigidBody& body = *simulation.pieces().at(0).body;
  const Vec3 there(0.0, 0.25, 0.0);
  BallJoint joint(world, body, box, local_place(body, there), local_place(box, there));
  Sums before = sums_of(simulation.model(0));
  before += sums_of(box);
  for (int tick = 0; tick < 120; ++tick) {
    world.step(kTick);
    const Vec3 apart =
        world_place(body, joint->getPivotInA()) - world_place(box, joint->getPivotInB());
    EXPECT_LT(apart.norm(), 3e-3) << tick;
  }
  ASSERT_FALSE(simulation.failure());
  Sums after = sums_of(simulation.model(0));
  after += sums_of(box);
  EXPECT_TRUE(box.isActive());
  EXPECT_GT(sums_of(box).momentum.norm(), 0.5);
  EXPECT_LT((after.momentum - before.momentum).norm(), by_precision(1e-3, 1e-11));
  EXPECT_LT(after.kinetic + after.elastic, 1.01 * before.kinetic);
}

// One that stands beside it is not kicked when a joint between the two wakes it.
TEST_P(JointInAnyRepresentation, WakesABodyWithoutAKick) {
  World world;
  world.add_ground();
  btRigidBody& box = world.add_box(Vec3::Constant(0.15), 5.0, {0.4, 0.15, 0.0});
  btRigidBody& on_top = world.add_box(Vec3::Constant(0.1), 2.0, {0.4, 0.4, 0.0});
  CoSimulation simulation(*world, settings_for(GetParam()));
  simulation.add(make_block({.modulus = 2e6, .internal_damping = 100.0}, {0.0, 0.15, 0.0}));
  world.run(5.0, kTick);
  ASSERT_FALSE(box.isActive());
  ASSERT_FALSE(on_top.isActive());
  btRigidBody& body = *simulation.pieces().at(0).body;
  const Vec3 between(0.2, 0.15, 0.0);
  BallJoint joint(world, body, box, local_place(body, between), local_place(box, between));
  body.activate();
  double fastest = 0.0;
  for (int tick = 0; tick < 60; ++tick) {
    world.step(kTick);
    for (const btRigidBody* b : {&box, &on_top}) {
      fastest = std::max(fastest, static_cast<double>(b->getLinearVelocity().length()));
    }
  }
  ASSERT_FALSE(simulation.failure());
  EXPECT_LT(fastest, 0.01);  // without gravity for what wakes: 0.085 (waking.h)
}

// A joint is not solved while its bodies sleep. What it bore then counts once, not in every tick.
TEST(JointLoad, OfASleepingPieceIsThatOfWhenItFellAsleep) {
  for (bool own_feedback : {false, true}) {
    SCOPED_TRACE(own_feedback);
    World world;
    CoSimulation simulation(*world);
    simulation.add(make_block({.modulus = 1e6}, -kTop));
    simulation.add(make_block({.modulus = 1e6}, {50.0, 0.0, 0.0}, {0.0, 30.0, 0.0}));  // awake
    btRigidBody& body = *simulation.pieces().at(0).body;
    BallJoint joint(world, body, local_place(body, Vec3::Zero()));
    btJointFeedback feedback = {};
    if (own_feedback) joint->setJointFeedback(&feedback);
    world.run(5.0, kTick);
    ASSERT_FALSE(body.isActive());
    world.run(2.0, kTick);
    body.activate();
    world.run(0.2, kTick);
    EXPECT_EQ(simulation.counters().to_flexible, 0u);
    EXPECT_EQ(joint->getJointFeedback(), own_feedback ? &feedback : nullptr);
  }
}

// A cell that breaks at a touch: nothing is left but debris.
TEST(Joint, OnWhatTurnsToDebrisOutlivesIt) {
  World world;
  {
    CoSimulation simulation(*world);
    PhysicalModel model = make_block({.cells = {1, 1, 1}, .modulus = 1e6}, Vec3::Zero());
    for (EdgeAttributes& edge : model.edges) edge.break_threshold = 1e-6;
    simulation.add(model);
    btRigidBody& body = *simulation.pieces().at(0).body;
    std::optional<BallJoint> joint(std::in_place, world, body, local_place(body, Vec3::Zero()));
    btRigidBody& slab = world.add_box({0.2, 0.05, 0.2}, 5.0, {0.0, 0.15, 0.0});
    slab.setLinearVelocity(btVector3(0, -5, 0));
    world.run(0.5, kTick);
    EXPECT_TRUE(simulation.pieces().empty());
    EXPECT_FALSE((*joint)->isEnabled());
    // It names a body of which nothing is left, and has to go before the object.
    ASSERT_EQ(simulation.constraints_on(0).size(), 1u);
    EXPECT_THROW(simulation.remove(0), InputError);
    joint.reset();
    simulation.remove(0);
  }
  world.run(0.1, kTick);
}

// A proxy on a joint of the usual kind, whose bodies collide, is in no free flight.
TEST(Joint, OfAProxyIsNotFlownPast) {
  World world;
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysRigid));
  simulation.add(make_block({}, -kTop));
  btRigidBody& body = *simulation.pieces().at(0).body;
  BallJoint joint(world, body, local_place(body, Vec3::Zero()));
  world.run(2.0, kTick);
  EXPECT_NEAR(body.getCenterOfMassPosition().y(), -0.15, 1e-3);
}

}  // namespace
}  // namespace limber::bullet::test
