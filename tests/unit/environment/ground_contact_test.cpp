#include "core/environment/ground_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/model/errors.h"
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
  Slope(double angle, double static_friction, double kinetic_friction, double speed,
        Integrator integrator = Integrator::kRungeKutta4)
      : operator_(lattice, integrator) {
    PhysicalModel model = test::chain({.points = 1, .mass = kMass});
    model.points[PointId(0)].velocity = {speed, 0.0, 0.0};
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
  TimeOperator operator_;
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

// ---- symplectic Euler --------------------------------------------------------------------------
// A constant acceleration a adds a dt^2 n (n + 1) / 2 to the path in n steps: a t^2 / 2 and
// a t dt / 2. Velocities and energies are exact.

Slope euler_slope(double angle, double static_friction, double kinetic_friction, double speed) {
  return {angle, static_friction, kinetic_friction, speed, Integrator::kSymplecticEuler};
}

// 510 steps at mu g. v0^2 / (2 mu g) less the method's v0 dt / 2.
TEST(GroundContact, StopsAnEulerPointWithTheBooksBalanced) {
  const double mu = 0.4, speed = 510 * mu * kG * kDt;
  Slope level = euler_slope(0.0, mu, mu, speed);
  level.run(509);
  EXPECT_NEAR(level.point().velocity.x(), mu * kG * kDt, 1e-12);
  const StepReport rest = level.run(491);
  EXPECT_EQ(level.point().velocity, Vec3::Zero());
  EXPECT_NEAR(level.point().position.x(), speed * speed / (2.0 * mu * kG) - 0.5 * speed * kDt,
              1e-12);
  EXPECT_NEAR(rest.ground.friction_J, 0.5 * kMass * std::pow(mu * kG * kDt, 2), 1e-15);
}

TEST(GroundContact, BooksWhatAnEulerPointLosesOnLevelGround) {
  const double mu = 0.4, speed = 2.0;
  const StepReport report = euler_slope(0.0, mu, mu, speed).run(1000);
  EXPECT_NEAR(report.ground.friction_J, 0.5 * kMass * speed * speed, 1e-12);
  EXPECT_NEAR(report.ground.impulse.x(), -kMass * speed, 1e-12);
  EXPECT_NEAR(report.ground.impulse.z(), kMass * kG * 1000 * kDt, 1e-10);
  EXPECT_EQ(report.ground.impact_J, 0.0);
}

TEST(GroundContact, HoldsAnEulerPointBelowStaticFriction) {
  const double angle = std::atan(0.499), steps = 300;
  Slope held = euler_slope(angle, 0.5, 0.3, 0.0);
  const StepReport report = held.run(300);
  EXPECT_EQ(held.point().velocity, Vec3::Zero());
  EXPECT_EQ(held.point().position, Vec3::Zero());
  // The ground takes all that gravity gives: its work on a point that is held is none.
  const Vec3 weight = kMass * held.environment.gravity;
  EXPECT_LT((report.ground.impulse + steps * kDt * weight).norm(), 1e-12);
}

// a = g (sin - mu_k cos) from the start. Friction takes mu_k N times the path; that of the velocity
// before friction, by which the report counts, is longer by mu_k g cos dt / 2 a step.
TEST(GroundContact, LetsAnEulerPointSlideAboveStaticFriction) {
  const double angle = std::atan(0.501), t = 300 * kDt;
  const double rubbed = 0.3 * kG * std::cos(angle), a = kG * std::sin(angle) - rubbed;
  Slope sliding = euler_slope(angle, 0.5, 0.3, 0.0);
  const StepReport report = sliding.run(300);
  const double path = sliding.point().position.x();
  EXPECT_NEAR(sliding.point().velocity.x(), a * t, 1e-12);
  EXPECT_NEAR(path, 0.5 * a * t * (t + kDt), 1e-12);
  EXPECT_NEAR(report.ground.friction_J, kMass * rubbed * (path + 0.5 * rubbed * t * kDt), 1e-12);
  const Vec3 gained = kMass * sliding.point().velocity;
  const Vec3 given = t * kMass * sliding.environment.gravity + report.ground.impulse;
  EXPECT_LT((gained - given).norm(), 1e-12);
}

// A plane that is tilted itself, off the origin: as above, down its slope.
TEST(GroundContact, SlidesDownATiltedPlane) {
  const double angle = 0.6, mu = 0.25, t = 300 * kDt;
  Slope tilted = euler_slope(0.0, mu, mu, 0.0);
  const Vec3 normal(std::sin(angle), std::cos(angle), 0.0), down(normal.y(), -normal.x(), 0.0);
  tilted.environment.gravity = {0.0, -kG, 0.0};
  tilted.environment.ground->normal = normal;
  tilted.environment.ground->height = 0.7;
  tilted.lattice.motion[0].position = 0.7 * normal;
  const StepReport report = tilted.run(300);
  const double a = kG * (std::sin(angle) - mu * std::cos(angle));
  const Vec3 moved = tilted.point().position - 0.7 * normal;
  EXPECT_LT((tilted.point().velocity - a * t * down).norm(), 1e-12);
  EXPECT_LT((moved - 0.5 * a * t * (t + kDt) * down).norm(), 1e-12);
  EXPECT_NEAR(report.ground.impulse.dot(normal), kMass * kG * std::cos(angle) * t, 1e-12);
}

// ---- impacts -----------------------------------------------------------------------------------

// (3, 0, -2) m/s, no gravity: the ground takes 2 m, and friction mu_k times that, in one step.
TEST(GroundContact, RubsByTheImpulseOfAnImpact) {
  for (Integrator integrator : {Integrator::kSymplecticEuler, Integrator::kRungeKutta4}) {
    Slope level(0.0, 0.5, 0.4, 3.0, integrator);
    level.environment.gravity.setZero();
    level.lattice.motion[0] = {{0.0, 0.0, 0.1}, {3.0, 0.0, -2.0}};
    const StepReport report = level.run(200);
    EXPECT_LT((level.point().velocity - Vec3(2.2, 0.0, 0.0)).norm(), 1e-12);
    EXPECT_EQ(level.point().position.z(), 0.0);
    EXPECT_LT((report.ground.impulse - kMass * Vec3(-0.8, 0.0, 2.0)).norm(), 1e-12);
    EXPECT_NEAR(report.ground.impact_J, 0.5 * kMass * 4.0, 1e-12);
    EXPECT_NEAR(report.ground.friction_J, 0.5 * kMass * (9.0 - 2.2 * 2.2), 1e-12);
  }
}

// ---- the start ---------------------------------------------------------------------------------

// Three points of a chain straight up from `lowest`, falling at 2 m/s.
struct Falling {
  explicit Falling(double lowest) {
    PhysicalModel model = test::chain({.points = 3, .mass = kMass, .along = Vec3::UnitZ()});
    for (Vec3& x : model.geometry.points) x.z() += lowest;
    for (PointAttributes& p : model.points) p.velocity = {1.0, 0.0, -2.0};
    lattice = test::lattice_of({std::move(model)});
    ground.normal = Vec3::UnitZ();
  }
  GroundReport stop() {
    GroundReport report;
    GroundContact().stop_what_enters(lattice, ground, report);
    return report;
  }

  Lattice lattice;
  Ground ground;
};

TEST(GroundContact, StopsAtTheStartWhatMovesIntoAHardGround) {
  Falling touching(0.0);
  const GroundReport report = touching.stop();
  EXPECT_EQ(touching.lattice.motion[0].velocity, Vec3(1.0, 0.0, 0.0));
  EXPECT_EQ(touching.lattice.motion[1].velocity, Vec3(1.0, 0.0, -2.0));
  EXPECT_NEAR(report.impulse.z(), 2.0 * kMass, 1e-15);
  EXPECT_NEAR(report.impact_J, 0.5 * kMass * 4.0, 1e-15);
  EXPECT_EQ(report.friction_J, 0.0);
}

TEST(GroundContact, LetsAtTheStartWhatIsAboveOrLeaves) {
  Falling above(1e-9);
  EXPECT_EQ(above.stop().impulse, Vec3::Zero());
  EXPECT_EQ(above.lattice.motion[0].velocity.z(), -2.0);
  Falling leaving(0.0);
  leaving.lattice.motion[0].velocity.z() = 2.0;
  EXPECT_EQ(leaving.stop().impulse, Vec3::Zero());
  EXPECT_EQ(leaving.lattice.motion[0].velocity.z(), 2.0);
}

TEST(GroundContact, LiftsAtTheStartWhatRoundingPutTooLow) {
  Falling rounded(-9e-7);
  EXPECT_NEAR(rounded.stop().impulse.z(), 2.0 * kMass, 1e-15);
  EXPECT_EQ(rounded.lattice.motion[0].position.z(), 0.0);
}

TEST(GroundContact, RefusesAPointDeepInAHardGround) {
  Falling deep(-1.25);
  deep.lattice.motion[0].position.z() = 3.0;  // the second one, 0.25 m deep, is the first in there
  const Vec3 before = deep.lattice.motion[1].velocity;
  try {
    deep.stop();
    FAIL() << "took it";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, "chain: point 1");
    EXPECT_EQ(error.diagnostic.what, "it lies 0.250000 m deep in a hard ground");
    EXPECT_EQ(error.diagnostic.remedy, "lift the object, or give the ground a stiffness");
  }
  EXPECT_EQ(deep.lattice.motion[1].velocity, before);
}

TEST(GroundContact, NamesTheObjectThatIsDeep) {
  Lattice lattice = test::lattice_of({test::chain({.origin = {0.0, 0.0, 5.0}}),
                                      test::chain({.origin = {9.0, 0.0, -2e-6}, .name = "sunk"})});
  Environment environment;
  environment.ground = Ground{.normal = Vec3::UnitZ()};
  try {
    TimeOperator(lattice).advance(1, kDt, environment);
    FAIL() << "took it";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.where, "sunk: point 0");
  }
}

// What does not move, and what a soft ground pushes out, may lie deep.
TEST(GroundContact, TakesPinnedPointsAndSoftGroundDeep) {
  PhysicalModel model = test::chain({.points = 1, .origin = {0.0, 0.0, -1.0}});
  model.points[PointId(0)].pinned = true;
  Falling pinned(5.0);
  pinned.lattice = test::lattice_of({model});
  EXPECT_EQ(pinned.stop().impulse, Vec3::Zero());
  EXPECT_EQ(pinned.lattice.motion[0].position.z(), -1.0);
  Falling soft(-1.0);
  soft.ground.stiffness = 100.0;
  EXPECT_EQ(soft.stop().impulse, Vec3::Zero());
  EXPECT_EQ(soft.lattice.motion[0].velocity.z(), -2.0);
}

}  // namespace
}  // namespace limber
