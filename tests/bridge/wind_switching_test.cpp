#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/bridge/measure.h"
#include "tests/bridge/models.h"
#include "tests/bridge/wind_models.h"
#include "tests/bridge/world.h"

// Objects that switch as they like fly and land as their lattices do.
//
// Symplectic Euler is of first order: x(dt / 2) - x(dt / 4) is the error of x(dt / 4), and without
// it remains the lattice's path for a vanishing substep, but for errors of second order. The body's
// is of fourth: it is nearer to that path than any of the lattices.

namespace limber::bullet::test {
namespace {

double magnitude(double x) { return std::abs(x); }
double magnitude(const Vec3& x) { return x.norm(); }

// A quantity of a lattice's path at the full substep, half of it and a quarter.
template <class T>
struct Refined {
  T full, half, quarter;

  T limit() const { return 2.0 * quarter - half; }
  double error_of_quarter() const { return magnitude(half - quarter); }
  double error_of_limit() const { return magnitude(limit() - (2.0 * half - full)); }
};

// ---- landing -----------------------------------------------------------------------------------

// Where and when the first point reaches the floor. What follows is no matter of the wind: an
// impact of so few points is chaotic, and two lattices of different substeps come to rest
// decimetres apart.
struct Landing {
  double time = 0.0;           // s
  Vec3 place = Vec3::Zero();   // m, of that point
  Vec3 centre = Vec3::Zero();  // m, of the whole
  double speed = 0.0;          // m/s, downwards
};

// From the last tick before it, by the parabola of every point (the air is left out: a millimetre,
// the same in all runs). False when nothing gets there within the tick.
bool lands_within_tick(const PhysicalModel& model, double now, Landing& landing) {
  double soonest = kTick;
  for (PointId p : ids_of(model.points)) {
    const Vec3 &x = model.geometry.points[p], &v = model.points[p].velocity;
    const double s = (v.y() + std::sqrt(v.y() * v.y() + 2.0 * kGravity * x.y())) / kGravity;
    if (s >= soonest) continue;
    soonest = s;
    const Vec3 fallen = -0.5 * kGravity * s * s * Vec3::UnitY();
    const Sums sums = sums_of(model);
    landing = {now + s, x + s * v + fallen, sums.centre() + s * sums.velocity() + fallen,
               kGravity * s - v.y()};
  }
  return soonest < kTick;
}

Landing landing(const PhysicalModel& model, Representation as, double step_scale) {
  World world;
  world.add_ground();
  // The limit of small substeps is an extrapolation that single precision has too few digits for.
  CoSimulationSettings settings = settings_for(as, step_scale);
  settings.springs = SpringPrecision::kDouble;
  CoSimulation simulation(*world, settings);
  simulation.set_air(gusting_air());
  simulation.add(model);
  Landing landing;
  for (int tick = 0; tick < 120; ++tick) {
    if (lands_within_tick(simulation.model(0), tick * kTick, landing)) return landing;
    world.step(kTick);
  }
  ADD_FAILURE() << "did not land";
  return landing;
}

class WindLanding : public testing::TestWithParam<PhysicalModel (*)()> {};

TEST_P(WindLanding, IsThatOfTheLattice) {
  const PhysicalModel model = GetParam()();
  const Landing switching = landing(model, Representation::kSwitching, 1.0);
  const Landing full = landing(model, Representation::kAlwaysFlexible, 1.0);
  const Landing half = landing(model, Representation::kAlwaysFlexible, 0.5);
  const Landing quarter = landing(model, Representation::kAlwaysFlexible, 0.25);
  const Refined<double> time{full.time, half.time, quarter.time};
  const Refined<Vec3> place{full.place, half.place, quarter.place};
  const Refined<Vec3> centre{full.centre, half.centre, quarter.centre};
  ASSERT_LT(time.error_of_limit(), 0.02 * time.error_of_quarter());
  // m: what the lattice at its substep is off by on its way down, four times what it is at a
  // quarter of it; what a second of Bullet's floats costs.
  const double distance =
      4.0 * (quarter.speed * time.error_of_quarter() + place.error_of_quarter());
  const double stored = by_precision(2e-5, 1e-9);
  EXPECT_LT(std::abs(switching.time - time.limit()),
            time.error_of_quarter() + stored / quarter.speed);
  EXPECT_LT((switching.place - place.limit()).norm(), distance + stored);
  EXPECT_LT((switching.centre - centre.limit()).norm(), distance + stored);
}

INSTANTIATE_TEST_SUITE_P(Things, WindLanding, testing::Values(leaf, plank),
                         [](const auto& thing) { return thing.index == 0 ? "Leaf" : "Plank"; });

// ---- switching on the way ----------------------------------------------------------------------

// 30 x 5 x 30 cm, 50 g, turning slowly in a breeze that strains it no more than it may be strained
// as a body; in a gust of 8 m/s it is.
PhysicalModel kite() {
  PhysicalModel model = make_block({.cells = {6, 1, 6},
                                    .spacing = 0.05,
                                    .mass = 0.05,
                                    .modulus = 3e4,
                                    .strain_at_break = 0.02,
                                    .damping_ratio = 0.2,
                                    .internal_damping = 30.0},
                                   Vec3::Zero(), Vec3::Zero(), {0.3, 0.5, 1.0});
  give_drag(model, 1.2, 0.05);
  return model;
}

Air wind_of(double speed) {
  Air air;
  air.wind.primitives = {uniform_flow(speed * Vec3(0.0, 1.0, 0.3).normalized())};
  return air;
}

// A third of a second of breeze, a gust, and no air at all.
std::optional<Air> weather(int tick) {
  if (tick < 20) return wind_of(0.3);
  if (tick < 30) return wind_of(8.0);
  return std::nullopt;
}

struct Kite {
  Kite(const PhysicalModel& model, Representation as, double step_scale)
      : simulation(*world, settings_for(as, step_scale)) {
    simulation.add(model);
  }
  void step(const std::optional<Air>& air) {
    simulation.set_air(air);
    world.step(kTick);
  }
  Sums sums() const { return sums_of(simulation.model(0)); }
  bool flexible() const { return simulation.pieces().at(0).flexible; }

  World world{0.0};
  CoSimulation simulation;
};

std::vector<Vec3> points_of(const Kite& kite) {
  const PhysicalModel model = kite.simulation.model(0);
  return {model.geometry.points.begin(), model.geometry.points.end()};
}

// From the lattice's limit, m; 2 (x(dt) - x(dt / 2)) is the error of x(dt).
struct Distances {
  double of_points = 0.0, error_of_full = 0.0;  // the largest
  double of_centre = 0.0, error_of_limit = 0.0;
};

Distances distances(const Kite& followed, const Kite& full, const Kite& half, const Kite& quarter) {
  const auto x = points_of(followed), a = points_of(full), b = points_of(half);
  const auto c = points_of(quarter);
  Distances largest;
  for (std::size_t p = 0; p < x.size(); ++p) {
    const Refined<Vec3> path{a[p], b[p], c[p]};
    largest.of_points = std::max(largest.of_points, (x[p] - path.limit()).norm());
    largest.error_of_full = std::max(largest.error_of_full, 2.0 * (a[p] - b[p]).norm());
  }
  const Refined<Vec3> centre{full.sums().centre(), half.sums().centre(), quarter.sums().centre()};
  largest.of_centre = (followed.sums().centre() - centre.limit()).norm();
  largest.error_of_limit = centre.error_of_limit();
  return largest;
}

// m, that the lattice's points are off the shape they had at first.
double bend(const Kite& lattice, const PhysicalModel& at_first) {
  const auto [rotation, centre] = lattice.simulation.placement(0);
  const Vec3 centre_then = sums_of(at_first).centre();
  const std::vector<Vec3> points = points_of(lattice);
  double largest = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec3 arm = at_first.geometry.points[PointId(p)] - centre_then;
    largest = std::max(largest, (points[p] - centre - rotation * arm).norm());
  }
  return largest;
}

// As a body its centre follows the lattice's limit, and its points are off by what the lattice has
// bent. Once it has been a lattice itself, it is no farther from it than the lattice at its substep
// is.
TEST(WindSwitching, FollowsTheLatticeThroughAGust) {
  const PhysicalModel model = kite();
  Kite switching(model, Representation::kSwitching, 1.0);
  Kite full(model, Representation::kAlwaysFlexible, 1.0);
  Kite half(model, Representation::kAlwaysFlexible, 0.5);
  Kite quarter(model, Representation::kAlwaysFlexible, 0.25);
  const double stored = by_precision(5e-6, 1e-9);  // m, of a second of floats
  bool thawed = false;
  for (int tick = 0; tick < 60; ++tick) {
    for (Kite* k : {&switching, &full, &half, &quarter}) k->step(weather(tick));
    thawed = thawed || switching.simulation.counters().to_flexible > 0;
    const Distances m = distances(switching, full, half, quarter);
    const double rigid = thawed ? 0.0 : bend(quarter, model);
    EXPECT_LT(m.of_points, m.error_of_full + rigid + stored) << tick;
    if (!thawed) {
      EXPECT_LT(m.of_centre, m.error_of_limit + stored) << tick;
    }
  }
  EXPECT_TRUE(thawed);
  EXPECT_FALSE(switching.flexible());
}

// About the centre of mass, kg m^2/s.
Vec3 spin_of(const Sums& sums) {
  return sums.angular_momentum - sums.centre().cross(sums.momentum);
}

// Relative to what the gust made of them, 0.3 kg m/s and 4e-4 kg m^2/s. L about the origin, metres
// away, is a thousand times larger: so are the roundings of the sum.
void expect_same_momenta(const Sums& got, const Sums& wanted) {
  const double share = by_precision(2e-6, 1e-13);
  EXPECT_LT((got.momentum - wanted.momentum).norm(), share * 0.3);
  EXPECT_LT((spin_of(got) - spin_of(wanted)).norm(), share * 4e-4 + 2e-15);
}

// Whatever it is when a tick begins and ends: if it is a lattice in between, it ends with the P, L
// and centre of a lattice that starts where it was and is not switched.
TEST(WindSwitching, SwitchesWithoutAJump) {
  Kite switching(kite(), Representation::kSwitching, 1.0);
  int thawed = 0, frozen = 0;
  for (int tick = 0; tick < 60; ++tick) {
    SCOPED_TRACE(tick);
    const PhysicalModel before = switching.simulation.model(0);
    const Counters counted = switching.simulation.counters();
    const bool was_flexible = switching.flexible();
    switching.step(weather(tick));
    const Counters& counts = switching.simulation.counters();
    const bool thaws = counts.to_flexible > counted.to_flexible;
    thawed += thaws;
    frozen += counts.to_rigid > counted.to_rigid && counts.to_flexible > 0;
    if (!weather(tick)) expect_same_momenta(switching.sums(), sums_of(before));
    if (!was_flexible && !thaws) continue;
    Kite lattice(before, Representation::kAlwaysFlexible, 1.0);
    lattice.step(weather(tick));
    expect_same_momenta(switching.sums(), lattice.sums());
    EXPECT_LT((switching.sums().centre() - lattice.sums().centre()).norm(),
              by_precision(1e-6, 1e-13));
  }
  EXPECT_EQ(thawed, 2);  // by the gust, and when it ends
  EXPECT_EQ(frozen, 2);
}

}  // namespace
}  // namespace limber::bullet::test
