#include "bullet_bridge/switch_policy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/bridge/models.h"
#include "tests/bridge/world.h"

namespace limber::bullet::test {
namespace {

// A ceramic plate and a lump of jelly.
const PieceStrength kPlate{.mass = 0.5, .wave_speed = 1000.0, .weakest_strain = 0.01};
const PieceStrength kJelly{.mass = 0.5, .wave_speed = 2.0, .weakest_strain = kUnbreakable};

TEST(ImpactStrain, OnTheGroundIsThatOfAPlaneWave) {
  EXPECT_DOUBLE_EQ(impact_strain(kPlate, 3.0, kUnbreakable), 0.003);
}

TEST(ImpactStrain, OfALightPartnerGoesWithTheRootOfItsMass) {
  // m_red / m = 1e-6 / (1 + 1e-6)
  EXPECT_NEAR(impact_strain(kPlate, 3.0, 0.5e-6), 0.003 * 1e-3, 1e-8);
  EXPECT_DOUBLE_EQ(impact_strain(kPlate, 3.0, 0.5), 0.003 * std::sqrt(0.5));
}

TEST(ImpactStrain, OfRecedingBodiesIsNone) {
  EXPECT_EQ(impact_strain(kPlate, 0.0, kUnbreakable), 0.0);
  EXPECT_EQ(impact_strain(kPlate, -3.0, kUnbreakable), 0.0);
}

TEST(ImpactStrain, GrowsWithSpeedAndPartner) {
  double last = 0.0;
  for (double speed = 0.1; speed < 100.0; speed *= 1.5) {
    const double strain = impact_strain(kPlate, speed, 2.0);
    EXPECT_GT(strain, last);
    last = strain;
  }
  last = 0.0;
  for (double mass = 1e-3; mass < 1e3; mass *= 2.0) {
    const double strain = impact_strain(kPlate, 1.0, mass);
    EXPECT_GT(strain, last);
    last = strain;
  }
  EXPECT_LT(last, impact_strain(kPlate, 1.0, kUnbreakable));
}

// A bar of 2 m and 3 cm^2 with E = 4e9 Pa and rho = 1000 kg/m^3 under 600 N: F / (E A) = 5e-4.
TEST(SustainedStrain, IsHookesLaw) {
  constexpr double kLength = 2.0, kSection = 3e-4, kModulus = 4e9, kDensity = 1000.0;
  const PieceStrength bar{.mass = kDensity * kLength * kSection,
                          .wave_speed = std::sqrt(kModulus / kDensity),
                          .weakest_strain = kUnbreakable};
  EXPECT_NEAR(sustained_strain(bar, 600.0, kLength), 600.0 / (kModulus * kSection), 1e-15);
  EXPECT_EQ(sustained_strain(bar, 0.0, kLength), 0.0);
  EXPECT_DOUBLE_EQ(sustained_strain(bar, 1200.0, kLength),
                   2.0 * sustained_strain(bar, 600.0, kLength));
}

TEST(FlexibleStrain, IsAQuarterOfTheStrengthButAtMostWhatIsSeen) {
  EXPECT_DOUBLE_EQ(flexible_strain(kPlate, {}), 0.0025);
  EXPECT_DOUBLE_EQ(flexible_strain(kJelly, {}), 0.01);
}

TEST(VibrationStrain, IsSpeedOverWaveSpeed) {
  EXPECT_DOUBLE_EQ(vibration_strain(kJelly, 0.1), 0.05);
}

// The same wobble of 5 cm/s is 2.5 % of strain in the jelly and 0.005 % in the plate.
TEST(Calm, IsTheStiffOneAndNotTheSoftOne) {
  EXPECT_FALSE(calm(kJelly, {}, {.rms_vibration = 0.05}));
  EXPECT_TRUE(calm(kPlate, {}, {.rms_vibration = 0.05}));
}

TEST(Calm, NeedsAVibrationBelowHalfOfWhatMakesFlexible) {
  EXPECT_TRUE(calm(kJelly, {}, {.rms_vibration = 0.00999}));
  EXPECT_FALSE(calm(kJelly, {}, {.rms_vibration = 0.01001}));
}

TEST(Calm, NeedsALoadThatIsLowOrSteady) {
  EXPECT_TRUE(calm(kPlate, {}, {.peak_load = 0.49, .peak_load_before = 0.9}));
  EXPECT_FALSE(calm(kPlate, {}, {.peak_load = 0.51, .peak_load_before = 0.9}));
  EXPECT_TRUE(calm(kPlate, {}, {.peak_load = 0.8, .peak_load_before = 0.84}));
  EXPECT_FALSE(calm(kPlate, {}, {.peak_load = 0.8, .peak_load_before = 0.74}));
}

// 2 L / c of 0.4 m of jelly is 0.4 s: 24 ticks; of the plate less than a millisecond, so that the
// settings decide, or two ticks where a foreseen touch did not come.
TEST(CalmTicks, LastAPeriodOfTheSlowestVibration) {
  EXPECT_EQ(calm_ticks_needed(kJelly, {}, 0.399, 1.0 / 60.0, true), 24);
  EXPECT_EQ(calm_ticks_needed(kPlate, {}, 0.4, 1.0 / 60.0, true), 3);
  EXPECT_EQ(calm_ticks_needed(kPlate, {}, 0.4, 1.0 / 60.0, false), 2);
}

// One step of a first-order filter over its own time constant covers 1 - 1/e of the way, however
// many steps it is divided into.
TEST(AveragingShare, ForgetsExponentially) {
  EXPECT_NEAR(averaging_share(0.1, 0.1), 1.0 - std::exp(-1.0), 1e-15);
  double average = 2.0;
  for (int i = 0; i < 10; ++i) average += (5.0 - average) * averaging_share(0.01, 0.1);
  EXPECT_NEAR(average, 5.0 - 3.0 * std::exp(-1.0), 1e-14);
}

// The same in a world: both fall freely and wobble at 5 cm/s.
TEST(Switching, KeepsWobblingJellyFlexibleAndTakesAStiffOneForRigid) {
  World world;
  CoSimulation simulation(*world);
  for (double modulus : {2e3, 2e8}) {
    const Block block{.cells = {2, 2, 2}, .mass = 8.0, .modulus = modulus, .damping_ratio = 0.001};
    PhysicalModel model = make_block(block, {modulus > 1e6 ? 3.0 : 0.0, 10.0, 0.0});
    // Breathing along x, 5 cm/s r.m.s.: the outer layers move, two thirds of the points' mass is
    // less than theirs.
    const double centre = modulus > 1e6 ? 3.0 : 0.0;
    for (PointId p : ids_of(model.points)) {
      const double side = model.geometry.points[p].x() - centre;
      if (std::abs(side) > 0.01) model.points[p].velocity.x() += side > 0.0 ? 0.07 : -0.07;
    }
    simulation.add(std::move(model));
  }
  world.run(4.0 * kTick, kTick);
  ASSERT_FALSE(simulation.failure());
  ASSERT_EQ(simulation.pieces().size(), 2u);
  EXPECT_TRUE(simulation.pieces()[0].flexible);
  EXPECT_FALSE(simulation.pieces()[1].flexible);
}

}  // namespace
}  // namespace limber::bullet::test
