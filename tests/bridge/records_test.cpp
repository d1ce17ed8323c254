#include <gtest/gtest.h>

#include <algorithm>

#include "core/operators/boundary_operator.h"
#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

// Objects that pins hold, and what is told of breaks and particles.

namespace limber::bullet::test {
namespace {

// A bar along x whose first layer of points is pinned.
PhysicalModel bracket(double strain_at_break) {
  PhysicalModel model = make_block({.cells = {6, 1, 1},
                                    .spacing = 0.1,
                                    .mass = 1.0,
                                    .modulus = 2e6,
                                    .strain_at_break = strain_at_break,
                                    .internal_damping = 5.0},
                                   {0.0, 3.0, 0.0});
  for (PointId p : ids_of(model.points)) {
    model.points[p].pinned = model.geometry.points[p].x() < -0.29;
  }
  return model;
}

TEST(Pinned, ObjectStaysFlexibleAndInItsPlace) {
  World world;
  CoSimulation simulation(*world);
  const PhysicalModel model = bracket(kUnbreakable);
  simulation.add(model);
  double lowest = lowest_point(model);
  for (int tick = 0; tick < 60; ++tick) {
    world.step(kTick);
    lowest = std::min(lowest, lowest_point(simulation.model(0)));
  }
  ASSERT_EQ(simulation.pieces().size(), 1u);
  EXPECT_TRUE(simulation.pieces()[0].flexible);
  const PhysicalModel now = simulation.model(0);
  for (PointId p : ids_of(model.points)) {
    if (!model.points[p].pinned) continue;
    EXPECT_EQ(now.geometry.points[p], model.geometry.points[p]);
    EXPECT_EQ(now.points[p].velocity, Vec3(Vec3::Zero()));
  }
  EXPECT_LT(lowest, lowest_point(model) - 1e-3);  // the free end sags
}

TEST(Pinned, ObjectCannotBeAlwaysRigid) {
  World world;
  CoSimulation simulation(*world, settings_for(Representation::kAlwaysRigid));
  EXPECT_THROW(simulation.add(bracket(kUnbreakable)), InputError);
}

// The bar breaks at the wall by its own weight: the free part falls and turns rigid, the pinned
// rest stays.
TEST(Pinned, WhatBreaksOffTurnsRigid) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(bracket(0.003));
  world.run(0.5, kTick);
  ASSERT_FALSE(simulation.breaks().empty());
  const auto pieces = simulation.pieces();
  EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [](const PieceView& piece) {
    return !piece.flexible && piece.motion.velocity.y() < -1.0;
  }));
}

// However light it is: a proxy that is about to hit it turns flexible as it would over a floor.
TEST(Pinned, LatticeIsAWallToWhatFallsOnIt) {
  World world;
  CoSimulation simulation(*world);
  const Block wide{.cells = {6, 1, 6}, .spacing = 0.1, .mass = 0.1, .modulus = 2e7};
  PhysicalModel shelf = make_block(wide, {0.0, -0.05, 0.0});
  for (PointAttributes& point : shelf.points) point.pinned = true;
  simulation.add(shelf);
  simulation.add(make_block({.strain_at_break = 0.05}, {0.0, 0.5, 0.0}, {0.0, -3.0, 0.0}));
  world.run(0.2, kTick);
  const auto& switches = simulation.switches();
  EXPECT_TRUE(std::any_of(switches.begin(), switches.end(), [](const SwitchRecord& record) {
    return record.object == 1 && record.cause == "touch";
  }));
}

TEST(BreakRecords, NameEdgeCellAndPiece) {
  World world;
  CoSimulation simulation(*world);
  const PhysicalModel authored = bracket(0.003);
  simulation.add(authored);
  world.run(0.5, kTick);
  const PhysicalModel model = simulation.model(0);
  const IndexRows cells_of = edge_cells(authored.geometry);
  ASSERT_FALSE(simulation.breaks().empty());
  double last = 0.0;
  for (const BreakRecord& record : simulation.breaks()) {
    EXPECT_GE(record.time, last);
    last = record.time;
    ASSERT_TRUE(model.edges.contains(EdgeId(record.edge)));
    EXPECT_TRUE(model.edges[EdgeId(record.edge)].broken);
    if (record.cell < 0) continue;
    EXPECT_FALSE(model.cells[CellId(record.cell)].valid);
    const auto cells = cells_of[record.edge];
    EXPECT_TRUE(std::find(cells.begin(), cells.end(), record.cell) != cells.end());
  }
}

TEST(SplitRecords, LeadFromTheWholeToThePiecesOfNow) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(bracket(0.003));
  std::vector<std::size_t> known = {simulation.pieces().at(0).id};
  world.run(0.5, kTick);
  ASSERT_FALSE(simulation.splits().empty());
  for (const SplitRecord& split : simulation.splits()) {
    const auto found = std::find(known.begin(), known.end(), split.piece);
    ASSERT_TRUE(found != known.end());
    known.erase(found);
    known.insert(known.end(), split.parts.begin(), split.parts.end());
  }
  std::vector<std::size_t> now;
  for (const PieceView& piece : simulation.pieces()) now.push_back(piece.id);
  std::sort(known.begin(), known.end());
  EXPECT_EQ(known, now);
}

// The tick ends after what broke in it.
TEST(SplitRecords, ComeAfterTheBreaksThatCausedThem) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(bracket(0.003));
  while (simulation.splits().empty() && simulation.counters().spring_updates < 100000000) {
    world.step(kTick);
  }
  ASSERT_FALSE(simulation.splits().empty());
  const double split = simulation.splits().front().time;
  EXPECT_GE(split, simulation.breaks().back().time);
  EXPECT_LE(split, simulation.breaks().back().time + kTick * (1.0 + 1e-6));
}

TEST(Surface, IsTheBoundaryOfWhatIsLeft) {
  World world;
  CoSimulation simulation(*world);
  simulation.add(bracket(0.003));
  world.run(0.5, kTick);
  ASSERT_FALSE(simulation.breaks().empty());
  const SurfaceModel kept = simulation.surface(0);
  const SurfaceModel afresh = boundary(simulation.model(0));
  ASSERT_EQ(kept.triangles.size(), afresh.triangles.size());
  for (std::size_t i = 0; i < kept.triangles.size(); ++i) {
    EXPECT_EQ(kept.triangles[i].source, afresh.triangles[i].source);
    EXPECT_EQ(kept.triangles[i].exposed_by_breaking, afresh.triangles[i].exposed_by_breaking);
  }
}

// A brick that shatters on the ground leaves particles.
TEST(Debris, IsCountedAndAgesAway) {
  const auto run = [](double lifetime) {
    World world;
    world.add_ground();
    CoSimulationSettings settings;
    settings.debris_lifetime = lifetime;
    CoSimulation simulation(*world, settings);
    simulation.add(
        make_block({.strain_at_break = 0.01}, {0.0, 0.4, 0.0}, {0.0, -25.0, 0.0}, {4.0, 3.0, 2.0}));
    world.run(1.0, kTick);
    return simulation.counters();
  };
  const Counters kept = run(10.0);
  EXPECT_GT(kept.particles, 0u);
  EXPECT_EQ(kept.retired_mass, 0.0);
  const Counters aged = run(0.1);
  EXPECT_EQ(aged.particles, kept.particles);
  EXPECT_GT(aged.retired_mass, 0.0);
}

}  // namespace
}  // namespace limber::bullet::test
