// Softening divides the modulus by S and multiplies the strain at break by sqrt(S). What that keeps
// is the speed at which an impact breaks the thing.

#include <gtest/gtest.h>

#include <cmath>

#include "core/modeller/box_lattice.h"
#include "core/modeller/material_table.h"
#include "core/operators/time_operator.h"

namespace limber {
namespace {

constexpr double kLength = 0.1;  // m

Material porcelain(double softening) {
  Material m = material_named("porcelain").material;
  m.damping_ratio = 0.1;
  m.softening = softening;
  return m;
}

TEST(Softening, KeepsStrainTimesWaveSpeed) {
  const Material real = porcelain(1.0);
  const double speed = 7e-4 * std::sqrt(7e10 / 2400.0);  // 3.78 m/s
  EXPECT_NEAR(critical_impact_speed(real), speed, 1e-9);
  for (double S : {2.0, 100.0, 2000.0})
    EXPECT_NEAR(critical_impact_speed(porcelain(S)), speed, 1e-9);
}

// An upright bar of 2 x 10 x 2 cells of 1 cm that falls on hard ground, in Earth's gravity.
bool breaks(double softening, double speed) {
  const Material material = porcelain(softening);
  PhysicalModel bar = with_material(
      box_lattice({2, 10, 2}, Vec3::Constant(0.01), Vec3::Zero(), "bar"), "bar", material);
  set_in_motion(bar, {0.0, -speed, 0.0}, Vec3::Zero());
  Lattice lattice;
  add_object(lattice, std::move(bar));
  rebuild_active(lattice);
  TimeOperator time(lattice);
  const Environment earth{.gravity = {0.0, -9.81, 0.0}, .ground = Ground{}};
  const double wave_speed = std::sqrt(material.effective_modulus() / material.density);
  const double dt = 0.5 * time.largest_step(earth);
  for (double t = 0.0; t < 4.0 * kLength / wave_speed; t += 20 * dt) {
    if (!time.advance(20, dt, earth).breaks.empty()) return true;
  }
  return false;
}

double critical_speed(double softening) {
  double survives = 0.1, fails = 20.0;
  EXPECT_FALSE(breaks(softening, survives));
  EXPECT_TRUE(breaks(softening, fails));
  while (fails / survives > 1.002) {
    const double speed = std::sqrt(survives * fails);
    (breaks(softening, speed) ? fails : survives) = speed;
  }
  return survives;
}

// What is not similar: strains grow with sqrt(S), to 0.03 at S = 2000, and gravity acts for sqrt(S)
// times as long (16 mm/s at S = 2000). Measured: 7.42, 7.39 and 7.59 m/s. (It is tension that
// breaks the bar, on the way back, so that strain x wave speed, 3.78 m/s, is no more than its
// order.)
TEST(Softening, KeepsTheSpeedThatBreaksABar) {
  const double real = critical_speed(1.0);
  EXPECT_GT(real, 0.5 * critical_impact_speed(porcelain(1.0)));
  EXPECT_LT(real, 3.0 * critical_impact_speed(porcelain(1.0)));
  EXPECT_NEAR(critical_speed(100.0) / real, 1.0, 0.02);
  EXPECT_NEAR(critical_speed(2000.0) / real, 1.0, 0.05);
}

}  // namespace
}  // namespace limber
