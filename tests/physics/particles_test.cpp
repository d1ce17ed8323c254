#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/operators/time_operator.h"

namespace limber {
namespace {

constexpr double kRadius = 0.01;  // m
constexpr double kGravity = 9.81;
constexpr double kFloor = 1e5;  // N/m

PhysicalModel grains(const std::vector<Vec3>& at, double mass, double restitution) {
  GeometricModelBuilder builder;
  builder.begin_subobject("grains");
  for (const Vec3& x : at) builder.add_point(x);
  PhysicalModel model = with_default_attributes(builder.finish(), "grains");
  for (PointAttributes& p : model.points) p.mass = mass;
  model.object.particle_radius = kRadius;
  model.object.restitution = restitution;
  return model;
}

Lattice compiled(PhysicalModel model) {
  Lattice lattice;
  add_object(lattice, std::move(model));
  rebuild_active(lattice);
  return lattice;
}

Vec3 momentum(const Lattice& lattice) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t p = 0; p < lattice.motion.size(); ++p)
    sum += lattice.mass[p] * lattice.motion[p].velocity;
  return sum;
}

double kinetic_energy(const Lattice& lattice) {
  double sum = 0.0;
  for (std::size_t p = 0; p < lattice.motion.size(); ++p)
    sum += 0.5 * lattice.mass[p] * lattice.motion[p].velocity.squaredNorm();
  return sum;
}

double nearest_distance(const Lattice& lattice) {
  double nearest = 1.0;
  for (std::size_t p = 0; p < lattice.motion.size(); ++p)
    for (std::size_t q = p + 1; q < lattice.motion.size(); ++q)
      nearest = std::min(nearest,
                         (lattice.motion[p].position - lattice.motion[q].position).norm());
  return nearest;
}

// Grains that lie side by side, 200 of them above the floor, each a little off its place.
std::vector<Vec3> loose_pile() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-0.002, 0.002);
  std::vector<Vec3> at;
  for (int y = 0; y < 8; ++y)
    for (int z = 0; z < 5; ++z)
      for (int x = 0; x < 5; ++x)
        at.push_back(Vec3(x, y + 1, z) * 0.025 + Vec3(off(random), off(random), off(random)));
  return at;
}

class TwoGrains : public ::testing::TestWithParam<double> {};

// Newton's law of impact, of equal masses: u' = (1 -+ e) / 2 v.
TEST_P(TwoGrains, PartWithTheirRestitution) {
  const double product = GetParam() * GetParam();
  Lattice lattice = compiled(grains({Vec3::Zero(), {0.05, 0.0, 0.0}}, 0.004, GetParam()));
  lattice.motion[0].velocity = {1.0, 0.0, 0.0};
  TimeOperator time(lattice);
  const double dt = 0.05 * time.largest_step();
  time.advance(static_cast<int>(0.2 / dt), dt, kEmptySpace);
  EXPECT_NEAR(lattice.motion[0].velocity.x(), 0.5 * (1.0 - product), 0.02);
  EXPECT_NEAR(lattice.motion[1].velocity.x(), 0.5 * (1.0 + product), 0.02);
  EXPECT_LT((momentum(lattice) - Vec3(0.004, 0.0, 0.0)).norm(), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Restitutions, TwoGrains, ::testing::Values(0.5, 0.8, 1.0));

TEST(Particles, WithoutARadiusPassThroughEachOther) {
  PhysicalModel model = grains({Vec3::Zero(), {0.05, 0.0, 0.0}}, 0.004, 1.0);
  model.object.particle_radius = 0.0;
  Lattice lattice = compiled(std::move(model));
  lattice.motion[0].velocity = {1.0, 0.0, 0.0};
  TimeOperator time(lattice);
  EXPECT_EQ(time.largest_step(), std::numeric_limits<double>::infinity());
  time.advance(100, 1e-3, kEmptySpace);
  EXPECT_NEAR(lattice.motion[0].position.x(), 0.1, 1e-12);
}

// Grains that touch from the start are a pile, not a shape: they bear each other at 2 r.
TEST(Particles, StackedOnePerchesAtTwiceTheRadius) {
  Lattice lattice = compiled(grains({{0, kRadius, 0}, {0, 3 * kRadius, 0}}, 0.004, 0.1));
  lattice.inverse_mass[0] = 0.0;
  TimeOperator time(lattice);
  Environment earth;
  earth.gravity = {0.0, -kGravity, 0.0};
  const double dt = 0.2 * time.largest_step(earth);
  time.advance(static_cast<int>(3.0 / dt), dt, earth);
  // The pair's spring has half a grain's mass and bears the weight at m g / (omega^2 m / 2); let go
  // without overlap the grain falls to twice that, and a contact that gives nothing back leaves it
  // there.
  const double omega = lattice.objects[0].contact_frequency;
  const double sink = 2.0 * kGravity / (omega * omega);
  EXPECT_LT(lattice.motion[1].position.y(), 3 * kRadius - 0.99 * sink);
  EXPECT_GT(lattice.motion[1].position.y(), 3 * kRadius - 2.01 * sink);
}

TEST(Particles, FallIntoAHeapAndNeverGainEnergy) {
  Lattice lattice = compiled(grains(loose_pile(), 0.004, 0.3));
  TimeOperator time(lattice);
  Environment earth;
  earth.gravity = {0.0, -kGravity, 0.0};
  earth.ground = Ground{.static_friction = 0.6, .kinetic_friction = 0.5};
  const double dt = time.largest_step(earth);
  const auto energy = [&] {
    double sum = kinetic_energy(lattice);
    for (const PointMotion& m : lattice.motion) sum += 0.004 * kGravity * m.position.y();
    return sum;
  };
  const double start = energy();
  for (double t = 0.0; t < 2.0; t += 50 * dt) {
    time.advance(50, dt, earth);
    ASSERT_LE(energy(), 1.001 * start) << "at " << t << " s";
  }
  EXPECT_LT(kinetic_energy(lattice), 1e-3 * start);
  // The lowest bear a column of cbrt(200) grains: 2 kContactSinkShare of a diameter, let go as above.
  EXPECT_GT(nearest_distance(lattice), 2.0 * kRadius * (1.0 - 4.0 * kContactSinkShare));
}

}  // namespace
}  // namespace limber
