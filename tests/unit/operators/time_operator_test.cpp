#include "core/operators/time_operator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "core/model/errors.h"
#include "tests/support/lattices.h"

// What advance() refuses before anything moves.

namespace limber {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Bystander : public SubstepCoupling {
 public:
  void add_forces(Lattice&, double) override {}
  void advance(Lattice&, double) override {}
};

// What advance() says about one step; nothing for a sound one. Whoever is refused stays as it was.
std::optional<Diagnostic> refusal(Lattice& lattice, Integrator integrator, double dt,
                                  const Environment& environment,
                                  SubstepCoupling* coupling = nullptr) {
  TimeOperator operator_(lattice, integrator);
  const std::vector<PointMotion> before = lattice.motion;
  std::optional<Diagnostic> said;
  try {
    operator_.advance(1, dt, environment, coupling);
  } catch (const InputError& error) {
    said = error.diagnostic;
    EXPECT_EQ(operator_.time(), 0.0);
    for (std::size_t p = 0; p < before.size(); ++p) {
      EXPECT_EQ(lattice.motion[p].position, before[p].position);
      EXPECT_EQ(lattice.motion[p].velocity, before[p].velocity);
    }
  }
  return said;
}

Lattice moving_pair() {
  Lattice lattice = test::lattice_of({test::chain({.origin = {0.0, 0.5, 0.0}})});
  for (PointMotion& point : lattice.motion) point.velocity = {1.0, 2.0, 3.0};
  return lattice;
}

constexpr Integrator kAllIntegrators[] = {Integrator::kSymplecticEuler, Integrator::kExplicitEuler,
                                          Integrator::kRungeKutta4};

TEST(TimeOperator, RefusesAStepThatIsNoTime) {
  const std::pair<double, const char*> steps[] = {
      {0.0, "0.000000 s"}, {-1e-3, "-0.001000 s"}, {kNaN, "nan s"}, {kInfinity, "inf s"}};
  for (Integrator integrator : kAllIntegrators) {
    for (const auto& [dt, as_text] : steps) {
      Lattice lattice = moving_pair();
      const auto said = refusal(lattice, integrator, dt, kEmptySpace);
      ASSERT_TRUE(said) << as_text;
      EXPECT_EQ(said->where, "time operator");
      EXPECT_THAT(said->what, testing::StrEq(std::string("the step is ") + as_text));
      EXPECT_EQ(said->remedy, "give a finite step above 0");
    }
  }
}

TEST(TimeOperator, RefusesCarriedPointsInARungeKuttaStepWithACoupling) {
  Bystander bodies;
  for (Integrator integrator : kAllIntegrators) {
    Lattice lattice = test::lattice_of(
        {test::chain({}), test::chain({.origin = {0.0, 5.0, 0.0}, .name = "carried"})});
    for (std::int32_t p : {2, 3}) lattice.role[p] = PointRole::kCarried;
    rebuild_active(lattice);
    EXPECT_FALSE(refusal(lattice, integrator, 1e-3, kEmptySpace)) << "nobody couples";
    const auto said = refusal(lattice, integrator, 1e-3, kEmptySpace, &bodies);
    ASSERT_EQ(said.has_value(), integrator != Integrator::kSymplecticEuler);
    if (!said) continue;
    EXPECT_EQ(said->where, "time operator");
    EXPECT_EQ(said->what, "points are carried by bodies in a Runge-Kutta step");
    EXPECT_EQ(said->remedy, "use symplectic Euler where lattices touch bodies that carry points");
  }
}

// ---- environments ------------------------------------------------------------------------------

// Sound, with everything in it.
Environment full_environment() {
  Ground ground;
  ground.stiffness = 1e3;
  ground.damping = 1.0;
  ground.static_friction = 0.6;
  ground.kinetic_friction = 0.5;
  FlowPrimitive doublet;
  doublet.kind = FlowKind::kLineDoublet;
  doublet.strength = Track<double>({{0.0, 1.0}, {1.0, 2.0}});
  Air air;
  air.wind.primitives = {uniform_flow({1.0, 0.0, 0.0}), doublet};
  return {.gravity = {0.0, -9.81, 0.0}, .air = air, .ground = ground};
}

struct BadEnvironment {
  std::function<void(Environment&)> change;
  const char *where, *what, *remedy;  // parts of the message
};

void expect_refused(std::initializer_list<BadEnvironment> environments) {
  for (const BadEnvironment& bad : environments) {
    Environment environment = full_environment();
    bad.change(environment);
    Lattice lattice = moving_pair();
    const auto said = refusal(lattice, Integrator::kSymplecticEuler, 1e-3, environment);
    ASSERT_TRUE(said) << bad.what;
    EXPECT_EQ(said->where, bad.where);
    EXPECT_THAT(said->what, HasSubstr(bad.what));
    EXPECT_THAT(said->remedy, HasSubstr(bad.remedy));
  }
}

Ground& ground(Environment& e) { return *e.ground; }
FlowPrimitive& doublet(Environment& e) { return e.air->wind.primitives[1]; }

TEST(TimeOperator, TakesASoundEnvironment) {
  for (Integrator integrator : kAllIntegrators) {
    Lattice lattice = moving_pair();
    EXPECT_FALSE(refusal(lattice, integrator, 1e-3, full_environment()));
  }
}

TEST(TimeOperator, RefusesGravityAndAirThatMakeNoSense) {
  expect_refused({
      {[](auto& e) { e.gravity.y() = kInfinity; }, "environment", "gravity is not finite",
       "finite numbers, m/s^2"},
      {[](auto& e) { e.air->density = -1.2; }, "air", "density is -1.2 kg/m^3", "0 or more"},
      {[](auto& e) { e.air->density = kNaN; }, "air", "density is nan kg/m^3", "finite"},
  });
}

TEST(TimeOperator, RefusesEachGroundThatMakesNoSense) {
  expect_refused({
      {[](auto& e) {
         ground(e).normal = {0.0, 1.1, 0.0};
       },
       "ground", "its normal is 1.1", "unit"},
      {[](auto& e) { ground(e).normal.setZero(); }, "ground", "its normal is 0", "unit vector"},
      {[](auto& e) { ground(e).height = kInfinity; }, "ground", "height is inf m", "finite"},
      {[](auto& e) { ground(e).stiffness = 0.0; }, "ground", "stiffness is 0 N/m", "above 0"},
      {[](auto& e) { ground(e).stiffness = -1.0; }, "ground", "stiffness is -1 N/m", "above 0"},
      {[](auto& e) { ground(e).stiffness = kNaN; }, "ground", "stiffness is nan N/m", "above 0"},
      {[](auto& e) { ground(e).damping = -2.0; }, "ground", "damping is -2 N s/m", "0 or more"},
      {[](auto& e) { ground(e).damping = kInfinity; }, "ground", "damping is inf N s/m", "finite"},
      {[](auto& e) { ground(e).stiffness = kInfinity; }, "ground", "hard and has damping",
       "finite stiffness or no damping"},
      {[](auto& e) { ground(e).kinetic_friction = -0.1; }, "ground", "-0.1 sliding", "0 or more"},
      {[](auto& e) { ground(e).kinetic_friction = 0.7; }, "ground",
       "friction is 0.6 at rest and 0.7 sliding", "at rest no less than sliding"},
      {[](auto& e) { ground(e).static_friction = kNaN; }, "ground", "nan at rest", "0 or more"},
  });
}

TEST(TimeOperator, RefusesEachFlowThatMakesNoSense) {
  const char* where = "wind: primitive 1";
  expect_refused({
      {[](auto& e) { doublet(e).position.keys.clear(); }, where, "position has no keys", "one"},
      {[](auto& e) { doublet(e).position = Vec3(0.0, 0.0, kNaN); }, where,
       "position: key 0 is not finite", "finite numbers"},
      {[](auto& e) { doublet(e).strength.keys.clear(); }, where, "strength has no keys", "one"},
      {[](auto& e) { doublet(e).strength.keys[1].value = kInfinity; }, where,
       "strength: key 1 is not finite", "finite numbers"},
      {[](auto& e) { doublet(e).strength.keys[1].time = kNaN; }, where,
       "strength: key 1 is not finite", "finite numbers"},
      {[](auto& e) { doublet(e).strength.keys[1].time = -1.0; }, where,
       "key 1 at -1 s does not come after the one before", "sort the keys"},
      {[](auto& e) { doublet(e).axis.setZero(); }, where, "no axis", "any length but zero"},
      {[](auto& e) { doublet(e).direction.x() = kNaN; }, where, "no direction", "but zero"},
      {[](auto& e) { doublet(e).direction = 2.0 * doublet(e).axis; }, where,
       "with its direction along its axis", "across the axis"},
      {[](auto& e) { doublet(e).core_radius = 0.0; }, where, "core radius is 0 m", "above 0"},
      {[](auto& e) { doublet(e).core_radius = kInfinity; }, where, "radius is inf m", "finite"},
      {[](auto& e) { doublet(e).bounds.centre.y() = kNaN; }, where, "centre of its bounds",
       "finite coordinates"},
      {[](auto& e) { doublet(e).bounds.radius = -1.0; }, where, "radius of its bounds is -1 m",
       "0 or more"},
      {[](auto& e) { doublet(e).bounds.fade = -1.0; }, where, "fade of its bounds is -1 m",
       "0 or more"},
  });
}

}  // namespace
}  // namespace limber
