#include <gtest/gtest.h>

#include <algorithm>

#include "core/modeller/cubic_lattice.h"
#include "core/operators/gluing_operator.h"
#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

// A brittle bar along x.
const Block kStick{.cells = {12, 1, 1},
                   .spacing = 0.04,
                   .mass = 1.0,
                   .modulus = 1e8,
                   .strain_at_break = 0.005,
                   .damping_ratio = 0.02,
                   .internal_damping = 60.0};

double mass_of_pieces(const CoSimulation& simulation) {
  double mass = simulation.debris_mass(0);
  for (const PieceView& piece : simulation.pieces()) mass += piece.motion.mass;
  return mass;
}

// P and L of the pieces, by what they are as rigid bodies, and of the points that are in none.
Sums sums_of_pieces(const CoSimulation& simulation) {
  const PhysicalModel model = simulation.model(0);
  std::vector<bool> debris(model.points.size(), true);
  Sums sums;
  for (const PieceView& piece : simulation.pieces()) {
    for (std::int32_t p : piece.points) debris[static_cast<std::size_t>(p)] = false;
    Sums one;
    one.add_point(piece.motion.mass, piece.motion.centre, piece.motion.velocity);
    one.angular_momentum += piece.motion.angular_momentum;
    sums += one;
  }
  for (PointId p : ids_of(model.points)) {
    if (!debris[p.index()]) continue;
    sums.add_point(model.points[p].mass, model.geometry.points[p], model.points[p].velocity);
  }
  return sums;
}

// Its ends fly apart at twice what the bar bears, and it turns.
PhysicalModel bursting_stick() {
  PhysicalModel stick = make_block(kStick, {0.0, 2.0, 0.0}, {1.0, 0.5, 0.2}, {0.0, 3.0, 1.0});
  for (PointId p : ids_of(stick.points)) {
    stick.points[p].velocity.x() += 20.0 * stick.geometry.points[p].x();
  }
  return stick;
}

TEST(BurstingStick, KeepsMassMomentumAndAngularMomentumInEveryTick) {
  World world(0.0);
  CoSimulation simulation(*world);
  const PhysicalModel stick = bursting_stick();
  simulation.add(stick);
  const Sums before = sums_of(stick);
  const double scale = std::sqrt(2.0 * before.kinetic * before.mass);
  const double tolerance = by_precision(1e-5, 1e-11);
  for (int tick = 0; tick < 120; ++tick) {
    SCOPED_TRACE(tick);
    world.step(kTick);
    ASSERT_FALSE(simulation.failure());
    const Sums now = sums_of_pieces(simulation);
    EXPECT_NEAR(mass_of_pieces(simulation), kStick.mass, 1e-6);
    EXPECT_LT((now.momentum - before.momentum).norm(), tolerance * scale);
    // About the origin, 2 to 4 m away.
    EXPECT_LT((now.angular_momentum - before.angular_momentum).norm(), 4.0 * tolerance * scale);
  }
  EXPECT_GE(simulation.pieces().size(), 2u);
  EXPECT_GT(simulation.counters().broken_edges, 0u);
}

TEST(BurstingStick, LeavesPiecesThatBecomeBodiesAndLatticesAgain) {
  World world(0.0);
  CoSimulation simulation(*world);
  simulation.add(bursting_stick());
  world.run(2.0, kTick);
  for (const PieceView& piece : simulation.pieces()) EXPECT_FALSE(piece.flexible);

  // A ball flies at the heaviest piece, faster than it.
  const auto pieces = simulation.pieces();
  const auto heaviest = std::max_element(
      pieces.begin(), pieces.end(),
      [](const PieceView& a, const PieceView& b) { return a.motion.mass < b.motion.mass; });
  const Vec3 side = 0.6 * Vec3::UnitY();
  btRigidBody& ball = world.add(std::make_unique<btSphereShape>(btScalar(0.1)), 5.0,
                                heaviest->motion.centre + side);
  ball.setLinearVelocity(to_bullet(Vec3(heaviest->motion.velocity - 30.0 * side)));
  const std::size_t thawed = simulation.counters().to_flexible;
  world.run(0.1, kTick);
  EXPECT_FALSE(simulation.failure());
  EXPECT_GT(simulation.counters().to_flexible, thawed);
}

// A model that comes from another simulation may be under load: 0.95 of what its springs bear.
TEST(Model, AddedUnderLoadIsALatticeFromTheStart) {
  World world(0.0);
  CoSimulation simulation(*world);
  PhysicalModel block = make_block({.strain_at_break = 0.01}, {0.0, 3.0, 0.0});
  for (Vec3& x : block.geometry.points) x.x() *= 1.0095;
  simulation.add(block);
  EXPECT_TRUE(simulation.pieces().at(0).flexible);
}

// A rope of 20 points hangs on a block by one bond and is pulled off: it is still a rope.
TEST(Rope, ThatComesOffABlockStaysOne) {
  const PhysicalModel block = make_block({}, Vec3::Zero());
  const Vec3 corner = block.geometry.points[PointId(0)];
  PhysicalModel rope = cubic_lattice({.points = {20, 1, 1},
                                      .spacing = 0.1,
                                      .origin = corner - Vec3(1.95, 0.0, 0.0),
                                      .springs = {.axial = 1e4},
                                      .mass = 0.01,
                                      .damping_per_stiffness = 1e-5});
  for (PointAttributes& point : rope.points) point.velocity = {-3.0, 0.0, 0.0};
  const GlueResult glued =
      glue(block, rope, {.distance = 0.06, .stiffness = 1e4, .break_strain = 0.01});
  ASSERT_EQ(glued.bonds, 1u);
  World world(0.0);
  CoSimulation simulation(*world);
  simulation.add(glued.model);
  world.run(0.3, kTick);
  EXPECT_EQ(simulation.breaks().size(), 1u);
  EXPECT_EQ(simulation.counters().broken_edges, 1u);
  EXPECT_EQ(simulation.counters().particles, 0u);
  ASSERT_EQ(simulation.pieces().size(), 2u);
  EXPECT_EQ(simulation.pieces()[1].points.size(), 20u);
}

TEST(StickOnAnEdge, BreaksAndComesToRestWithAllItsMass) {
  World world;
  world.add_ground();
  world.add_box({0.01, 0.1, 0.3}, 0.0, {0.0, 0.1, 0.0});
  CoSimulation simulation(*world);
  simulation.add(make_block(kStick, {0.0, 0.8, 0.0}));
  const double start = kGravity * 0.8 * kStick.mass;
  for (int tick = 0; tick < 300; ++tick) {
    world.step(kTick);
    ASSERT_FALSE(simulation.failure());
    EXPECT_LT(sums_of(simulation.model(0)).energy(kGravity), start * 1.01) << "tick " << tick;
    EXPECT_NEAR(mass_of_pieces(simulation), kStick.mass, 1e-6);
  }
  EXPECT_GE(simulation.pieces().size(), 2u);
  for (const PieceView& piece : simulation.pieces()) {
    EXPECT_FALSE(piece.flexible);
    EXPECT_LT(piece.motion.velocity.norm(), 0.05);
    EXPECT_GT(piece.motion.centre.y(), 0.0);
  }
}

}  // namespace
}  // namespace limber::bullet::test
