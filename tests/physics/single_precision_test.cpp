// Long runs with springs in single precision beside the same ones in double precision.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/modeller/box_lattice.h"
#include "core/modeller/material.h"
#include "core/operators/time_operator.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kSide = 0.2;  // m
constexpr SpringPrecision kBoth[] = {SpringPrecision::kDouble, SpringPrecision::kSingle};

// A cube of fired clay, softened a thousand times, without damping.
Material clay() {
  Material material;
  material.density = 2000.0;
  material.youngs_modulus = 1.5e10;
  material.softening = 1000.0;
  return material;
}

PhysicalModel cube(int points, const Material& material) {
  const int cells = points - 1;
  PhysicalModel model = with_material(
      box_lattice({cells, cells, cells}, Vec3::Constant(kSide / cells), Vec3::Zero(), "cube"),
      "cube", material);
  model.object.contact_share = 0.0;
  return model;
}

// Stretched along x as in its lowest longitudinal mode.
Vec3 mode_shape(const Vec3& x) { return {-std::cos(std::numbers::pi * x.x() / kSide), 0.0, 0.0}; }

// By `strain` at the most.
void stretch(Lattice& lattice, double strain) {
  for (PointMotion& m : lattice.motion)
    m.position += strain * kSide / std::numbers::pi * mode_shape(m.position);
}

class LongRun {
 public:
  LongRun(Lattice lattice, SpringPrecision precision, double step_share)
      : lattice_(std::move(lattice)),
        time_(lattice_, Integrator::kSymplecticEuler, precision),
        dt_(step_share * time_.largest_step()) {}

  const Lattice& lattice() const { return lattice_; }
  double dt() const { return dt_; }
  StepReport advance(int substeps, const Environment& environment = kEmptySpace) {
    return time_.advance(substeps, dt_, environment);
  }

  // Over a thousand substeps, J: symplectic Euler's energy swings by omega dt / 2.
  double mean_energy() {
    double sum = 0.0;
    for (int n = 0; n < 200; ++n) {
      advance(5);
      sum += test::totals(lattice_).energy() / 200;
    }
    return sum;
  }

 private:
  Lattice lattice_;
  TimeOperator time_;
  double dt_;
};

Lattice vibrating(double strain, const Vec3& velocity = Vec3::Zero()) {
  Lattice lattice = test::lattice_of({cube(10, clay())});
  stretch(lattice, strain);
  for (PointMotion& m : lattice.motion) m.velocity += velocity;
  return lattice;
}

double share_of_energy_lost(double strain, SpringPrecision precision) {
  LongRun run(vibrating(strain), precision, 0.5);
  const double before = run.mean_energy();
  run.advance(20000);
  return std::abs(run.mean_energy() / before - 1.0);
}

// Measured: 5e-5 and 7e-5 in double precision, which is symplectic Euler's swing, 1.4e-4 and 9e-5
// in single.
TEST(SinglePrecision, EnergyOfAVibrationDoesNotDriftOver20000Substeps) {
  for (SpringPrecision precision : kBoth) {
    EXPECT_LT(share_of_energy_lost(1e-3, precision), 1e-3);
    EXPECT_LT(share_of_energy_lost(1e-2, precision), 1e-3);
  }
}

struct Drift {
  double momentum = 0.0, angular_momentum = 0.0;  // relative to the sums of magnitudes
};

Drift drift_of_momenta(SpringPrecision precision) {
  Lattice lattice = vibrating(1e-3, {3.0, -2.0, 1.0});
  const Vec3 centre = Vec3::Constant(0.5 * kSide);
  for (PointMotion& m : lattice.motion)
    m.velocity += Vec3(1.0, 5.0, -3.0).cross(m.position - centre);
  LongRun run(std::move(lattice), precision, 0.5);
  const test::Totals before = test::totals(run.lattice());
  run.advance(20000);
  const test::Totals after = test::totals(run.lattice());
  return {
      (after.momentum - before.momentum).norm() / before.momentum_scale,
      (after.angular_momentum - before.angular_momentum).norm() / before.angular_momentum_scale};
}

// Each force has its exact reaction, but sums at points are rounded to single precision (measured:
// 1e-9), and directions to a quantum, 6e-8 of an edge (2e-8). Double precision keeps both to 6e-15.
TEST(SinglePrecision, MomentaAreKept) {
  const Drift exact = drift_of_momenta(SpringPrecision::kDouble);
  EXPECT_LT(exact.momentum, 1e-12);
  EXPECT_LT(exact.angular_momentum, 1e-12);
  const Drift fast = drift_of_momenta(SpringPrecision::kSingle);
  EXPECT_LT(fast.momentum, 1e-8);
  EXPECT_LT(fast.angular_momentum, 1e-7);
}

double elongation(const Lattice& lattice) {
  double sum = 0.0;
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    const Vec3& rest = lattice.authored_position[p];
    sum += (lattice.motion[p].position - rest).dot(mode_shape(rest));
  }
  return sum;
}

// When the block has passed its rest shape downwards for the nth time, s.
double time_of_passage(LongRun& run, int n) {
  double last = elongation(run.lattice());
  for (int step = 1; step < 1000000; ++step) {
    run.advance(1);
    const double now = elongation(run.lattice());
    if (last > 0.0 && now <= 0.0 && --n == 0) return (step - now / (now - last)) * run.dt();
    last = now;
  }
  ADD_FAILURE() << "no vibration";
  return 0.0;
}

// 49 substeps a period. Reciprocals that are wrong by 1e-4 change the stiffness by half of it; the
// frequency differs by 2e-5 (measured).
TEST(SinglePrecision, AVibrationKeepsItsPhaseOver100Periods) {
  LongRun exact(vibrating(1e-3), SpringPrecision::kDouble, 0.5);
  LongRun fast(vibrating(1e-3), SpringPrecision::kSingle, 0.5);
  const double first = time_of_passage(exact, 1);
  const double hundred_periods = time_of_passage(exact, 100);
  ASSERT_GT(hundred_periods, 10.0 * exact.dt() * 100.0);  // many substeps each
  EXPECT_NEAR(time_of_passage(fast, 1), first, 1e-4 * first);
  EXPECT_NEAR(time_of_passage(fast, 100) / hundred_periods, 1.0, 1e-4);
}

// ---------------------------------------------------------------------------------------------

double edges_broken_in_a_fall(SpringPrecision precision, double step_share) {
  Material brittle = clay();
  brittle.strain_at_break = 3e-4;
  brittle.damping_ratio = 0.2;
  PhysicalModel model = cube(8, brittle);
  const Mat3 turned = Eigen::AngleAxisd(0.3, Vec3(1.0, 0.5, 2.0).normalized()).toRotationMatrix();
  place(model, turned, {0.0, 0.2, 0.0});
  set_in_motion(model, {0.0, -6.0, 0.0}, Vec3::Zero());
  Lattice lattice = test::lattice_of({model});
  LongRun run(std::move(lattice), precision, step_share);
  const Environment floor = {.gravity = {0.0, -kStandardGravity, 0.0}, .ground = Ground{}};
  double broken = 0.0;
  for (double t = 0.0; t < 0.06; t += 100 * run.dt())
    broken += static_cast<double>(run.advance(100, floor).broken_edges);
  return broken;
}

struct Spread {
  double mean = 0.0, deviation = 0.0;
};

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  for (double v : values) spread.mean += v / values.size();
  for (double v : values)
    spread.deviation += (v - spread.mean) * (v - spread.mean) / (values.size() - 1);
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

// Breaking is chaotic: steps that differ by a thousandth give other cracks, and so do other
// roundings: 4494 +- 196 edges in double precision, 4466 +- 224 in single. Both means are uncertain
// by deviation / sqrt(runs); three times that is the bound.
TEST(SinglePrecision, ABlockBreaksAsMuchAsInDoublePrecision) {
  constexpr int kRuns = 8;
  std::vector<double> exact, fast;
  for (int i = 0; i < kRuns; ++i) {
    exact.push_back(edges_broken_in_a_fall(SpringPrecision::kDouble, 1.0 - 0.002 * i));
    fast.push_back(edges_broken_in_a_fall(SpringPrecision::kSingle, 1.0 - 0.002 * i));
  }
  const Spread of_exact = spread_of(exact), of_fast = spread_of(fast);
  EXPECT_GT(of_exact.mean, 100.0);
  EXPECT_LE(std::abs(of_fast.mean - of_exact.mean),
            3.0 * std::hypot(of_exact.deviation, of_fast.deviation) / std::sqrt(double(kRuns)));
}

// ---------------------------------------------------------------------------------------------

// Alumina, unsoftened: springs of 1e9 N/m.
Material alumina(double damping_ratio) {
  Material material;
  material.density = 3900.0;
  material.youngs_modulus = 3.8e11;
  material.damping_ratio = damping_ratio;
  return material;
}

// m/s, the fastest point in 20 samples of a block that begins at rest.
double fastest_at_rest(double damping_ratio, SpringPrecision precision) {
  LongRun run(test::lattice_of({cube(10, alumina(damping_ratio))}), precision, 0.5);
  double fastest = 0.0;
  for (int n = 0; n < 20; ++n) {
    run.advance(503);
    for (const PointMotion& m : run.lattice().motion)
      fastest = std::max(fastest, m.velocity.norm());
  }
  return fastest;
}

// Rounding pushes at random, a strain of 1e-7 in every substep, and damping takes it out again.
// Measured, as a share of the speed of sound: 7e-7 for a damping ratio of 0.02, 4e-7 for 0.05, 2e-7
// for 0.2. Without damping the heat adds up, to 2e-5 in 20,000 substeps.
TEST(SinglePrecision, AStiffDampedBlockAtRestStaysAtRest) {
  const Material material = alumina(0.2);
  const double speed_of_sound = std::sqrt(material.youngs_modulus / material.density);
  EXPECT_LT(fastest_at_rest(0.2, SpringPrecision::kSingle), 5e-7 * speed_of_sound);
  EXPECT_LT(fastest_at_rest(0.2, SpringPrecision::kDouble), 1e-13 * speed_of_sound);
}

}  // namespace
}  // namespace limber
