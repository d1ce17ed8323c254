// Points against faces, together with the point-point penalty: what is thin, fine or fast is
// stopped.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/operators/time_operator.h"
#include "tests/support/blocks.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kSpacing = 0.02;     // m
constexpr double kWaveSpeed = 500.0;  // m/s
constexpr double kDensity = 1000.0;   // kg/m^3

void make_unbreakable(PhysicalModel& model, double mass, double stiffness) {
  for (PointAttributes& p : model.points) p.mass = mass;
  for (EdgeAttributes& e : model.edges) {
    e.stiffness = stiffness;
    e.damping = 0.0;
    e.break_threshold = kUnbreakable;
  }
  model.object.friction = 0.0;
}

PhysicalModel block(std::array<int, 3> cells, double spacing, const Vec3& origin) {
  PhysicalModel model = test::block({.cells = cells, .spacing = spacing, .origin = origin});
  const double mass = kDensity * std::pow(spacing, 3);
  make_unbreakable(model, mass, mass * std::pow(kWaveSpeed / spacing, 2));
  return model;
}

// n x n squares in the plane z = 0, its centre near the origin.
PhysicalModel flat_sheet(int n, double spacing, double wave_speed) {
  PhysicalModel model = test::sheet(n, true);
  const Vec3 centre(0.5 * n - 0.18, 0.5 * n - 0.35, 0.0);
  for (Vec3& x : model.geometry.points) x = spacing * (x - centre);
  for (EdgeAttributes& e : model.edges) e.rest_length *= spacing;
  constexpr double kMass = 1e-3;
  make_unbreakable(model, kMass, kMass * std::pow(wave_speed / spacing, 2));
  return model;
}

// Twenty points 2 mm apart, its point at z = 3 mm, a little oblique.
PhysicalModel needle(double speed) {
  constexpr double kMass = 5e-5, kNeedleSpacing = 0.002;
  PhysicalModel model = test::chain({.points = 20,
                                     .stiffness = kMass * std::pow(1000.0 / kNeedleSpacing, 2),
                                     .mass = kMass,
                                     .spacing = kNeedleSpacing,
                                     .origin = {0.0031, 0.0013, 0.003},
                                     .along = Vec3(0.05, 0.02, 1.0).normalized()});
  model.object.friction = 0.0;
  set_in_motion(model, {0.0, 0.0, -speed}, Vec3::Zero());
  return model;
}

double mean_of(const Lattice& lattice, std::size_t object, auto value) {
  const IdRange<PointId> points = lattice.objects[object].points;
  double sum = 0.0;
  for (std::int32_t p = points.begin; p < points.end; ++p) sum += value(lattice.motion[p]);
  return sum / static_cast<double>(points.size());
}

double mean_z(const Lattice& lattice, std::size_t object) {
  return mean_of(lattice, object, [](const PointMotion& m) { return m.position.z(); });
}

// Point-first onto `target` for long enough to pass it twice over. It must end up moving away
// on the side it came from, with momenta kept and no energy gained.
void expect_stopped(PhysicalModel target, double speed) {
  Lattice lattice = test::lattice_of({std::move(target), needle(speed)});
  TimeOperator time(lattice);
  const double dt = time.largest_step();
  const test::Totals before = test::totals(lattice);
  time.advance(static_cast<int>(0.1 / speed / dt) + 5000, dt, kEmptySpace);
  const test::Totals after = test::totals(lattice);
  EXPECT_GT(mean_z(lattice, 1), mean_z(lattice, 0)) << speed << " m/s";
  const auto speed_of = [&](std::size_t object) {
    return mean_of(lattice, object, [](const PointMotion& m) { return m.velocity.z(); });
  };
  EXPECT_GT(speed_of(1), speed_of(0)) << speed << " m/s";
  test::expect_same_momenta(before, after, 1e-12);
  EXPECT_LT(after.energy(), before.energy());
}

TEST(SurfaceContact, StopsANeedleAtABlock) {
  for (double speed : {1.0, 10.0, 50.0, 200.0}) {
    expect_stopped(block({6, 6, 4}, kSpacing, {-0.0637, -0.0671, -0.08}), speed);
  }
}

TEST(SurfaceContact, StopsANeedleAtASheet) {
  for (double speed : {1.0, 10.0, 50.0, 200.0}) {
    expect_stopped(flat_sheet(8, kSpacing, kWaveSpeed), speed);
  }
}

// Cells of 20 and of 12.5 mm, closing at a share of the wave speed. Through each other, the second
// would end up below the first.
TEST(SurfaceContact, BlocksOfDifferentSpacingDoNotPassThroughEachOther) {
  for (double share : {0.05, 0.1, 0.2, 0.35, 0.5}) {
    PhysicalModel lower = block({4, 4, 4}, kSpacing, Vec3::Zero());
    PhysicalModel upper = block({7, 7, 7}, 0.0125, {0.0031, 0.0047, 0.095});
    const double speed = 0.5 * share * kWaveSpeed;
    set_in_motion(lower, {0.0, 0.0, speed}, Vec3::Zero());
    set_in_motion(upper, {0.0, 0.0, -speed}, Vec3::Zero());
    Lattice lattice = test::lattice_of({lower, upper});
    TimeOperator time(lattice);
    const double dt = time.largest_step();
    const test::Totals before = test::totals(lattice);
    time.advance(static_cast<int>(0.5 / speed / dt), dt, kEmptySpace);
    EXPECT_GT(mean_z(lattice, 1) - mean_z(lattice, 0), 0.0875) << share << " of the wave speed";
    const test::Totals after = test::totals(lattice);
    test::expect_same_momenta(before, after, 1e-12);
    EXPECT_LT(after.energy(), before.energy());
  }
}

// A sheet falls on the tip of a pin between its points, and hangs on it.
TEST(SurfaceContact, ASheetHangsOnAPin) {
  PhysicalModel sheet = flat_sheet(10, kSpacing, 100.0);
  for (EdgeAttributes& e : sheet.edges) e.damping = 0.02;
  set_in_motion(sheet, {0.0, 0.0, -5.0}, Vec3::Zero());
  PhysicalModel pin = test::chain({.points = 2,
                                   .stiffness = 2500.0,
                                   .mass = 1e-3,
                                   .spacing = 0.004,
                                   .origin = {0.0, 0.0, -0.02},
                                   .along = -Vec3::UnitZ()});
  for (PointAttributes& p : pin.points) p.pinned = true;
  pin.object.friction = 0.0;
  Lattice lattice = test::lattice_of({sheet, pin});
  TimeOperator time(lattice);
  const double dt = time.largest_step();
  const Environment environment{.gravity = {0.0, 0.0, -9.81}};
  time.advance(static_cast<int>(0.2 / dt), dt, environment);
  double highest = -1.0;
  for (int p = 0; p < 121; ++p) highest = std::max(highest, lattice.motion[p].position.z());
  EXPECT_GT(highest, -0.03);  // falling freely it would be 1.2 m below
  EXPECT_LT(mean_z(lattice, 0), highest);
}

// A sheet in the shape of a U, arms 40 mm apart that close at 8 m/s.
PhysicalModel closing_fold() {
  PhysicalModel model = flat_sheet(16, 0.01, 100.0);
  constexpr double kRadius = 0.02, kHalf = kRadius * std::numbers::pi / 2.0;
  for (PointId p : ids_of(model.geometry.points)) {
    Vec3& x = model.geometry.points[p];
    const double u = x.x();
    if (std::abs(u) <= kHalf) {
      x = {-kRadius * std::cos(u / kRadius), x.y(), kRadius * std::sin(u / kRadius)};
      continue;
    }
    x = {std::abs(u) - kHalf, x.y(), std::copysign(kRadius, u)};
    model.points[p].velocity.z() = std::copysign(4.0, -u);
  }
  for (EdgeId e : ids_of(model.geometry.edges)) {
    const auto& [a, b] = model.geometry.edges[e];
    model.edges[e].rest_length = (model.geometry.points[a] - model.geometry.points[b]).norm();
    model.edges[e].damping = 0.01;
  }
  model.object.contact_share = 0.1;
  return model;
}

// How much higher the upper arm is than the lower one, in the mean, m.
double gap_between_arms(const Lattice& lattice) {
  double sum = 0.0;
  for (int row = 0; row < 17; ++row) {
    for (int i = 0; i < 4; ++i) {
      sum += lattice.motion[17 * row + 16 - i].position.z() -
             lattice.motion[17 * row + i].position.z();
    }
  }
  return sum / (17.0 * 4.0);
}

TEST(SurfaceContact, AFoldingSheetDoesNotPassItself) {
  Lattice lattice = test::lattice_of({closing_fold()});
  TimeOperator time(lattice);
  const double dt = time.largest_step();
  const test::Totals before = test::totals(lattice);
  EXPECT_NEAR(gap_between_arms(lattice), 0.04, 1e-3);
  for (int look = 0; look < 6; ++look) {
    time.advance(static_cast<int>(0.005 / dt), dt, kEmptySpace);
    // Through each other, it would be down to -0.1 m. Wavy, arms that touch may cross by their
    // waves.
    EXPECT_GT(gap_between_arms(lattice), -1e-3);
  }
  test::expect_same_momenta(before, test::totals(lattice), 1e-11);
  EXPECT_LT(test::totals(lattice).energy(), before.energy());
}

// Of 1 g and 1 mm, off every lattice point.
PhysicalModel grain(double speed) {
  PhysicalModel model = test::chain({.points = 1, .mass = 1e-3, .origin = {0.0033, 0.0051, 0.02}});
  model.object.particle_radius = 0.001;
  model.object.friction = 0.0;
  set_in_motion(model, {0.0, 0.0, -speed}, Vec3::Zero());
  return model;
}

TEST(SurfaceContact, AGrainReboundsFromASheetAndABlock) {
  for (double speed : {2.0, 20.0, 200.0}) {
    for (const PhysicalModel& target :
         {flat_sheet(8, kSpacing, kWaveSpeed), block({6, 6, 4}, kSpacing, {-0.06, -0.06, -0.08})}) {
      Lattice lattice = test::lattice_of({target, grain(speed)});
      TimeOperator time(lattice);
      const double dt = time.largest_step();
      time.advance(static_cast<int>(0.5 / speed / dt), dt, kEmptySpace);
      EXPECT_GT(mean_z(lattice, 1), mean_z(lattice, 0)) << target.name << ", " << speed << " m/s";
    }
  }
}

}  // namespace
}  // namespace limber
