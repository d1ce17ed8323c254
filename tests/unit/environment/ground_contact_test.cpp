#include "core/environment/ground_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/operators/time_operator.h"
#include "tests/support/lattices.h"

namespace limber {
namespace {

constexpr double kG = 9.81;    // m/s^2
constexpr double kMass = 0.4;  // kg
constexpr double kDt = 1e-3;   // s

// One point on flat hard ground, z = 0, with gravity as if the ground were tilted by `angle`: down
// the slope is +x.
struct Slope {
  Slope(double angle, double static_friction, double kinetic_friction, double speed) {
    GeometricModelBuilder builder;
    builder.begin_subobject("point");
    builder.add_point(Vec3::Zero());
    PhysicalModel model = with_default_attributes(builder.finish(), "point");
    model.points.raw()[0] = {kMass, speed * Vec3::UnitX(), false};
    lattice = test::lattice_of({model});
    Ground ground;
    ground.normal = Vec3::UnitZ();
    ground.static_friction = static_friction;
    ground.kinetic_friction = kinetic_friction;
    environment.gravity = kG * Vec3(std::sin(angle), 0.0, -std::cos(angle));
    environment.ground = ground;
  }
  StepReport run(int steps) { return operator_.advance(steps, kDt, environment); }
  const PointMotion& point() const { return lattice.motion[0]; }

  Lattice lattice;
  Environment environment;
  TimeOperator operator_{lattice, Integrator::kRungeKutta4};
};

// tan(angle) = 0.4 lies between both coefficients: what was never pushed is held by the static one.
TEST(GroundContact, HoldsWhatStartsAtRestUpToStaticFriction) {
  Slope held(std::atan(0.4), 0.5, 0.3, 0.0);
  held.run(200);
  EXPECT_EQ(held.point().velocity, Vec3::Zero());
  EXPECT_EQ(held.point().position.x(), 0.0);
}

// What slides there goes on sliding: a = g (sin - mu_k cos), in any step exactly.
TEST(GroundContact, SlowsWhatSlidesByKineticFriction) {
  const double angle = std::atan(0.4), speed = 0.05, duration = 200 * kDt;
  const double a = kG * (std::sin(angle) - 0.3 * std::cos(angle));
  Slope sliding(angle, 0.5, 0.3, speed);
  sliding.run(200);
  EXPECT_NEAR(sliding.point().velocity.x(), speed + a * duration, 1e-12);
  EXPECT_NEAR(sliding.point().position.x(), speed * duration + 0.5 * a * duration * duration,
              1e-12);
}

TEST(GroundContact, LetsGoAboveStaticFriction) {
  Slope sliding(std::atan(0.501), 0.5, 0.3, 0.0);
  sliding.run(200);
  EXPECT_GT(sliding.point().velocity.x(), 0.9 * kG * 0.17 * 200 * kDt);
}

// mu_k g slows it: v0^2 / (2 mu_k g) far, with all of its energy. Then it stays.
TEST(GroundContact, StopsWithTheBooksBalanced) {
  const double mu = 0.4, speed = 2.0;
  Slope level(0.0, mu, mu, speed);
  const StepReport report = level.run(1000);
  EXPECT_EQ(level.point().velocity, Vec3::Zero());
  EXPECT_NEAR(level.point().position.x(), speed * speed / (2.0 * mu * kG), 1e-5);
  EXPECT_NEAR(report.ground.friction_J, 0.5 * kMass * speed * speed, 1e-12);
  EXPECT_NEAR(report.ground.impulse.z(), kMass * kG * 1000 * kDt, 1e-10);
  EXPECT_NEAR(report.ground.impulse.x(), -kMass * speed, 1e-12);
}

}  // namespace
}  // namespace limber
