// The verdict of a break is that of the converged run: the speed at which a bar breaks does not hang
// on the step or on the resolution.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"
#include "core/operators/time_operator.h"

namespace limber {
namespace {

constexpr double kModulus = 1e8;     // Pa
constexpr double kDensity = 2000.0;  // kg/m^3
constexpr double kWidth = 0.1;       // m
constexpr double kLength = 0.6;      // m
constexpr double kStrain = 0.01;     // at break

// An upright bar, its lower end at y = 0.
PhysicalModel bar(int cells_across, bool either_way) {
  const int along = static_cast<int>(std::lround(cells_across * kLength / kWidth));
  PhysicalModel model =
      with_material(box_lattice({cells_across, along, cells_across},
                                Vec3::Constant(kWidth / cells_across), Vec3::Zero(), "bar"),
                    "bar",
                    {.density = kDensity,
                     .youngs_modulus = kModulus,
                     .strain_at_break = kStrain,
                     .damping_ratio = 0.1});
  for (EdgeAttributes& e : model.edges) {
    if (either_way) e.crush_threshold = e.break_threshold;
  }
  return model;
}

// A rigid floor under an elastic pad as stiff as 0.1 m of the bar's material: the front it sends
// into the bar is as long at every resolution. (Hitting bare rock makes a front as long as one cell,
// which rings at every resolution and has no limit.)
class Pad : public SubstepCoupling {
 public:
  explicit Pad(double spacing) : frequency_squared_(kModulus / 0.1 / (kDensity * spacing / 2.0)) {}
  void add_forces(Lattice& lattice, double) override {
    for (std::int32_t p : lattice.dynamic_points) {
      const double depth = std::max(0.0, -lattice.motion[p].position.y());
      lattice.force[p].y() += frequency_squared_ * lattice.mass[p] * depth;
    }
  }
  void advance(Lattice&, double) override {}

 private:
  double frequency_squared_;  // k / m of a point on the lower end, (rad/s)^2
};

bool breaks(PhysicalModel model, int cells_across, double speed, double step_scale) {
  set_in_motion(model, {0.0, -speed, 0.0}, Vec3::Zero());
  Lattice lattice;
  add_object(lattice, std::move(model));
  rebuild_active(lattice);
  TimeOperator time(lattice);
  Pad pad(kWidth / cells_across);
  const double there_and_back = 2.0 * kLength / std::sqrt(kModulus / kDensity);  // s
  const double dt = step_scale * time.largest_step();
  for (double t = 0.0; t < 1.6 * there_and_back; t += 100 * dt) {
    if (!time.advance(100, dt, kEmptySpace, &pad).breaks.empty()) return true;
  }
  return false;
}

double critical_speed(int cells_across, bool either_way, double step_scale) {
  const PhysicalModel model = bar(cells_across, either_way);
  double survives = 1.0, fails = 16.0;
  while (fails / survives > 1.001) {
    const double speed = std::sqrt(survives * fails);
    (breaks(model, cells_across, speed, step_scale) ? fails : survives) = speed;
  }
  return survives;
}

class CriticalSpeed : public testing::TestWithParam<bool> {};  // breaks either way?

TEST_P(CriticalSpeed, IsThatOfTheConvergedRun) {
  const double full = critical_speed(3, GetParam(), 1.0);
  const double half = critical_speed(3, GetParam(), 0.5);
  const double quarter = critical_speed(3, GetParam(), 0.25);
  const auto [least, most] = std::minmax({full, half, quarter});
  EXPECT_LT(most / least, 1.02) << full << " " << half << " " << quarter;
  const double finer = critical_speed(4, GetParam(), 0.5);
  EXPECT_LT(std::abs(finer / half - 1.0), 0.05) << half << " " << finer;
}

// In compression the first front decides: strain v / c, a little more for the front's overshoot.
TEST(CriticalSpeed, IsNearStrainTimesWaveSpeed) {
  const double wave_speed = std::sqrt(kModulus / kDensity);
  EXPECT_NEAR(critical_speed(3, true, 0.5) / (kStrain * wave_speed), 1.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Rules, CriticalSpeed, testing::Bool(),
                         [](const auto& rule) { return rule.param ? "EitherWay" : "OnStretch"; });

}  // namespace
}  // namespace limber
