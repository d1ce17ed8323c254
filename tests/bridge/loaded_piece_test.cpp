// A piece that is rigid under a load: it was in its shape already when it turned rigid.

#include <gtest/gtest.h>

#include "bullet_bridge/co_simulation.h"
#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

// The weight strains the block by 0.5 %, half of what would show. Floor and weight both press it:
// it bears twice that, and did so when it turned rigid.
TEST(LoadedPiece, BetweenFloorAndWeightTurnsRigidAndStaysSo) {
  constexpr double kWeight = 10.0;  // kg
  const Block block{.modulus = 2e5, .damping_ratio = 0.1, .internal_damping = 20.0};
  World world;
  world.add_ground();
  CoSimulation simulation(*world, settings_for(Representation::kSwitching));
  simulation.add(make_block(block, {0.0, 0.5 * block.size().y(), 0.0}));
  world.add_box(Vec3::Constant(0.1), kWeight, {0.0, block.size().y() + 0.1, 0.0});
  world.run(4.0, kTick);
  ASSERT_FALSE(simulation.failure()) << simulation.failure()->text();
  ASSERT_FALSE(simulation.pieces().at(0).flexible);
  const std::size_t switches = simulation.switches().size();
  EXPECT_GE(simulation.counters().to_flexible, 1u);
  world.run(4.0, kTick);
  EXPECT_EQ(simulation.switches().size(), switches);
}

}  // namespace
}  // namespace limber::bullet::test
