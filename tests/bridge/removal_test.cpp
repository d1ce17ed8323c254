#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/storage/state_hash.h"
#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Objects leave a simulation, in either representation and while others touch them.

namespace limber::bullet::test {
namespace {

constexpr double kBoxHalf = 0.1;  // m

PhysicalModel soft_block(const Vec3& centre, const std::string& name = "block") {
  PhysicalModel model = make_block({.modulus = 1e6, .internal_damping = 100.0}, centre);
  model.name = name;
  return model;
}

std::uint64_t bits_of(const World& world) {
  StateHash hash;
  for (const auto& body : world.bodies()) {
    const btTransform& pose = body->getWorldTransform();
    for (const btVector3& v :
         {pose.getOrigin(), pose.getBasis()[0], pose.getBasis()[1], pose.getBasis()[2],
          body->getLinearVelocity(), body->getAngularVelocity()}) {
      for (int k = 0; k < 3; ++k) hash.add(v[k]);
    }
    hash.add(body->getActivationState());
  }
  return hash.value();
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class Removal : public testing::TestWithParam<Representation> {
 protected:
  CoSimulationSettings settings() const { return settings_for(GetParam()); }
};

// A box lies on a block that lies on the ground: without the block it falls to the ground.
TEST_P(Removal, LetsWhatLayOnItFall) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, settings());
  simulation.add(soft_block({0.0, 0.15, 0.0}));
  btRigidBody& box = world.add_box(Vec3::Constant(kBoxHalf), 1.0, {0.0, 0.4, 0.0});
  world.run(1.0, kTick);
  ASSERT_NEAR(box.getWorldTransform().getOrigin().y(), 0.4, 0.03);
  const int bodies = world->getNumCollisionObjects();
  simulation.remove(0);
  EXPECT_EQ(world->getNumCollisionObjects(), bodies - 1);
  EXPECT_TRUE(simulation.pieces().empty());
  world.run(1.0, kTick);
  EXPECT_FALSE(simulation.failure());
  EXPECT_NEAR(box.getWorldTransform().getOrigin().y(), kBoxHalf, 0.005);
}

// It wakes, and falls from the next tick on as any body does: with the gravity of one tick.
TEST_P(Removal, WakesWhatSleptOnIt) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, settings());
  simulation.add(soft_block({0.0, 0.15, 0.0}));
  btRigidBody& lower = world.add_box(Vec3::Constant(kBoxHalf), 0.1, {0.0, 0.4, 0.0});
  btRigidBody& upper = world.add_box(Vec3::Constant(kBoxHalf), 0.1, {0.0, 0.6, 0.0});
  world.run(5.0, kTick);
  if (GetParam() != Representation::kAlwaysFlexible) {  // on a lattice nothing sleeps for long
    ASSERT_FALSE(lower.isActive());
    ASSERT_FALSE(upper.isActive());
  }
  simulation.remove(0);
  world.step(kTick);
  for (const btRigidBody* box : {&lower, &upper}) {
    EXPECT_NEAR(box->getLinearVelocity().y(), -kGravity * kTick, 0.02) << (box == &upper);
  }
}

// What does not touch it, and sleeps, sleeps on.
TEST_P(Removal, WakesNobodyElse) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world, settings());
  simulation.add(soft_block({0.0, 0.15, 0.0}));
  btRigidBody& away = world.add_box(Vec3::Constant(kBoxHalf), 0.1, {1.0, 0.1, 0.0});
  world.run(5.0, kTick);
  ASSERT_FALSE(away.isActive());
  simulation.remove(0);
  world.step(kTick);
  EXPECT_FALSE(away.isActive());
}

TEST_P(Removal, KeepsTheIndicesAndRecordsOfOthers) {
  World world(0.0);
  CoSimulation simulation(*world, settings());
  const std::size_t first = simulation.add(soft_block(Vec3::Zero(), "first"));
  const std::size_t second = simulation.add(soft_block({2.0, 0.0, 0.0}, "second"));
  const btRigidBody* const body = simulation.pieces().at(1).body;
  const std::size_t records = simulation.switches().size();
  simulation.remove(first);
  EXPECT_FALSE(simulation.has_object(first));
  EXPECT_TRUE(simulation.has_object(second));
  EXPECT_EQ(simulation.object_count(), 2u);
  EXPECT_EQ(simulation.switches().size(), records);
  ASSERT_EQ(simulation.pieces().size(), 1u);
  EXPECT_EQ(simulation.pieces().at(0).object, second);
  EXPECT_EQ(simulation.pieces().at(0).body, body);
  EXPECT_EQ(simulation.object_of(*body), second);
  EXPECT_EQ(simulation.model(second).name, "second");
  const std::size_t third = simulation.add(soft_block({4.0, 0.0, 0.0}, "third"));
  EXPECT_EQ(third, 2u);
  world.run(0.1, kTick);
  EXPECT_EQ(simulation.model(third).name, "third");
  EXPECT_NEAR(sums_of(simulation.model(third)).centre().x(), 4.0, 1e-6);
}

TEST_P(Removal, HasQuestionsAboutItRefusedByName) {
  World world(0.0);
  CoSimulation simulation(*world, settings());
  simulation.add(soft_block(Vec3::Zero(), "vase"));
  simulation.remove(0);
  const std::vector<std::function<void()>> questions = {
      [&] { simulation.model(0); },
      [&] { simulation.surface(0); },
      [&] { simulation.debris_mass(0); },
      [&] { simulation.flexible_points(0); },
      [&] { simulation.placement(0); },
      [&] { simulation.constraints_on(0); },
      [&] { simulation.apply_impulse(0, Vec3::UnitX(), Vec3::Zero()); },
      [&] { simulation.remove(0); },
  };
  for (std::size_t i = 0; i < questions.size(); ++i) {
    EXPECT_EQ(message_of(questions[i]),
              "object 0 (vase): it was removed; ask has_object() before, or forget its index when "
              "you remove it")
        << i;
  }
  EXPECT_EQ(message_of([&] { simulation.model(7); }),
            "object 7: there is none: 1 were added; use an index that add() returned");
}

TEST_P(Removal, IsRefusedWhileConstraintsHoldIt) {
  World world;
  CoSimulation simulation(*world, settings());
  simulation.add(soft_block(Vec3::Zero(), "lamp"));
  simulation.add(soft_block({3.0, 0.0, 0.0}));
  btRigidBody& body = *simulation.pieces().at(0).body;
  btPoint2PointConstraint hook(body, btVector3(0, btScalar(0.15), 0));
  world->addConstraint(&hook);
  world.run(0.1, kTick);
  EXPECT_EQ(message_of([&] { simulation.remove(0); }),
            "lamp: 1 of the world's constraints name its bodies; take those that constraints_on() "
            "lists out of the world first");
  ASSERT_EQ(simulation.pieces().size(), 2u);
  EXPECT_TRUE(simulation.constraints_on(1).empty());
  for (btTypedConstraint* constraint : simulation.constraints_on(0)) {
    world->removeConstraint(constraint);
  }
  simulation.remove(0);
  world.run(0.1, kTick);
  EXPECT_FALSE(simulation.failure());
}

class Remover : public btActionInterface {
 public:
  CoSimulation* simulation = nullptr;
  std::string message;
  void updateAction(btCollisionWorld*, btScalar) override {
    message = message_of([&] { simulation->remove(0); });
  }
  void debugDraw(btIDebugDraw*) override {}
};

TEST_P(Removal, IsRefusedInTheMiddleOfAStep) {
  World world;
  Remover remover;
  world->addAction(&remover);  // before Limber's own
  CoSimulation simulation(*world, settings());
  remover.simulation = &simulation;
  simulation.add(soft_block(Vec3::Zero(), "jar"));
  world.step(kTick);
  EXPECT_EQ(remover.message,
            "jar: it cannot be removed in the middle of a step; remove it before or after "
            "stepSimulation()");
  world->removeAction(&remover);
  simulation.remove(0);
  world.step(kTick);
  EXPECT_FALSE(simulation.failure());
}

// Boxes and two objects in a heap. From the removal on the world is as if Limber were not there.
class Heap {
 public:
  explicit Heap(const CoSimulationSettings& settings)
      : simulation(std::make_unique<CoSimulation>(*world, settings)) {
    world.add_ground();
    simulation->add(soft_block({0.0, 0.2, 0.0}));
    simulation->add(soft_block({0.05, 0.9, 0.05}));
    for (int i = 0; i < 6; ++i) {
      world.add_box(Vec3::Constant(kBoxHalf), 0.5, {0.03 * i, 1.3 + 0.25 * i, -0.02 * i});
    }
    world.run(0.8, kTick);
    simulation->remove(0);
    simulation->remove(1);
  }
  World world;
  std::unique_ptr<CoSimulation> simulation;
};

TEST_P(Removal, OfAllLeavesPlainBullet) {
  Heap attached(settings()), detached(settings());
  detached.simulation.reset();
  const std::uint64_t start = bits_of(attached.world);
  for (int tick = 0; tick < 300; ++tick) {
    ASSERT_EQ(bits_of(attached.world), bits_of(detached.world)) << "tick " << tick;
    attached.world.step(kTick);
    detached.world.step(kTick);
  }
  EXPECT_NE(bits_of(attached.world), start);
}

// Two blocks far apart, of which one is struck: removing the other changes no bit of it.
TEST_P(Removal, ChangesNoBitOfAnotherObject) {
  const auto bits = [&](bool remove) {
    World world;
    world.add_ground();
    CoSimulation simulation(*world, settings());
    simulation.add(soft_block({-5.0, 0.3, 0.0}));
    simulation.add(soft_block({5.0, 0.3, 0.0}));
    world.run(0.3, kTick);
    if (remove) simulation.remove(0);
    world.run(0.5, kTick);
    StateHash hash;
    for (const Vec3& x : simulation.model(1).geometry.points) hash.add(std::span(x.data(), 3));
    return hash.value();
  };
  EXPECT_EQ(bits(true), bits(false));
}

INSTANTIATE_TEST_SUITE_P(InAnyRepresentation, Removal,
                         testing::Values(Representation::kSwitching,
                                         Representation::kAlwaysFlexible,
                                         Representation::kAlwaysRigid));

// A brittle block that fell into pieces and debris: all of them go.
TEST(RemovalOfWhatBroke, TakesPiecesAndDebrisAlong) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world);
  simulation.add(make_block({.strain_at_break = 0.002}, {0.0, 0.4, 0.0}, {0.0, -9.0, 0.0}));
  world.run(0.1, kTick);
  ASSERT_GT(simulation.debris_mass(0), 0.0);
  ASSERT_FALSE(simulation.breaks().empty());
  const std::size_t breaks = simulation.breaks().size();
  const std::uint64_t updates = simulation.counters().spring_updates;
  simulation.remove(0);
  EXPECT_TRUE(simulation.pieces().empty());
  EXPECT_EQ(world->getNumCollisionObjects(), 1);
  const std::uint64_t then = simulation.state_hash();
  world.run(0.2, kTick);
  EXPECT_EQ(simulation.state_hash(), then);
  EXPECT_EQ(simulation.counters().spring_updates, updates);
  EXPECT_EQ(simulation.counters().stored_J, 0.0);
  EXPECT_EQ(simulation.breaks().size(), breaks);
}

// The lattices stand still after a failure; what caused it can go all the same.
TEST(RemovalAfterAFailure, Works) {
  World world;
  CoSimulation simulation(*world);
  PhysicalModel wild = soft_block(Vec3::Zero());
  wild.points[PointId(std::size_t{0})].velocity.x() = 1e300;
  simulation.add(std::move(wild));
  simulation.add(soft_block({3.0, 0.0, 0.0}));
  world.step(kTick);
  ASSERT_TRUE(simulation.failure());
  simulation.remove(0);
  simulation.remove(1);
  EXPECT_EQ(world->getNumCollisionObjects(), 0);
  world.run(0.1, kTick);
}

// The same place in memory may come again for another body.
TEST(RemovalAgainAndAgain, GivesTheSameRunEachTime) {
  World world;
  world.add_ground();
  CoSimulation simulation(*world);
  double first = 0.0;
  for (int i = 0; i < 20; ++i) {
    const std::size_t object = simulation.add(soft_block({0.0, 0.3, 0.0}));
    world.run(0.5, kTick);
    const double height = sums_of(simulation.model(object)).centre().y();
    if (i == 0) first = height;
    EXPECT_NEAR(height, first, by_precision(1e-5, 1e-9)) << i;
    simulation.remove(object);
  }
  EXPECT_EQ(world->getNumCollisionObjects(), 1);
}

}  // namespace
}  // namespace limber::bullet::test
