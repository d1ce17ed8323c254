#include "core/environment/environment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/model/errors.h"

namespace limber {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A valid environment with everything in it.
Environment full_environment() {
  FlowPrimitive doublet;
  doublet.kind = FlowKind::kLineDoublet;
  doublet.strength = Track<double>({{0.0, 1.0}, {1.0, 2.0}});
  Ground ground;
  ground.static_friction = 0.6;
  ground.kinetic_friction = 0.5;
  return {.gravity = {0, -9.81, 0}, .air = Air{.wind = {{doublet}}}, .ground = ground};
}

// What the message says after `change`; empty if nothing is wrong.
std::string complaint(const std::function<void(Environment&)>& change) {
  Environment environment = full_environment();
  change(environment);
  try {
    require_valid(environment);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string flow_complaint(const std::function<void(FlowPrimitive&)>& change) {
  return complaint([&](Environment& e) { change(e.air->wind.primitives[0]); });
}

std::string ground_complaint(const std::function<void(Ground&)>& change) {
  return complaint([&](Environment& e) { change(*e.ground); });
}

TEST(Environment, ThatIsSoundPasses) {
  EXPECT_EQ(complaint([](Environment&) {}), "");
  EXPECT_EQ(complaint([](Environment& e) { e = kEmptySpace; }), "");
  // A vortex needs no direction, uniform flow no axis.
  EXPECT_EQ(flow_complaint([](FlowPrimitive& p) {
              p.kind = FlowKind::kLineVortex;
              p.direction.setZero();
            }),
            "");
  EXPECT_EQ(flow_complaint([](FlowPrimitive& p) {
              p.kind = FlowKind::kUniform;
              p.axis.setZero();
            }),
            "");
}

TEST(Environment, NamesWhatIsWrongWithAPrimitive) {
  const std::string where = "wind: primitive 0: ";
  const auto expect = [&](const std::string& what, const std::function<void(FlowPrimitive&)>& do_) {
    EXPECT_THAT(flow_complaint(do_), HasSubstr(where + what));
  };
  expect("has no axis", [](FlowPrimitive& p) { p.axis.setZero(); });
  expect("has no direction", [](FlowPrimitive& p) { p.direction.setZero(); });
  expect("is a line doublet with its direction along its axis",
         [](FlowPrimitive& p) { p.direction = -3.0 * p.axis; });
  expect("core radius is 0 m", [](FlowPrimitive& p) { p.core_radius = 0.0; });
  expect("strength has no keys", [](FlowPrimitive& p) { p.strength.keys.clear(); });
  expect("strength: key 1 at 0 s does not come after",
         [](FlowPrimitive& p) { p.strength.keys[1].time = 0.0; });
  expect("position: key 0 is not finite", [](FlowPrimitive& p) { p.position = Vec3(0, kNaN, 0); });
  expect("radius of its bounds is -1 m", [](FlowPrimitive& p) { p.bounds.radius = -1.0; });
  expect("fade of its bounds is nan m", [](FlowPrimitive& p) { p.bounds.fade = kNaN; });
  expect("centre of its bounds", [](FlowPrimitive& p) { p.bounds.centre.x() = kNaN; });
}

TEST(Environment, NamesWhatIsWrongWithTheGround) {
  const auto expect = [](const std::string& what, const std::function<void(Ground&)>& change) {
    EXPECT_THAT(ground_complaint(change), HasSubstr("ground: " + what));
  };
  expect("length of its normal is 2", [](Ground& g) { g.normal = {0, 2, 0}; });
  expect("height is nan m", [](Ground& g) { g.height = kNaN; });
  expect("stiffness is 0 N/m", [](Ground& g) { g.stiffness = 0.0; });
  expect("damping is -1 N s/m", [](Ground& g) { g.damping = -1.0; });
  expect("is hard and has damping", [](Ground& g) { g.damping = 1.0; });
  expect("friction is 0.6 at rest and 0.7 sliding", [](Ground& g) { g.kinetic_friction = 0.7; });
}

TEST(Environment, NamesWhatIsWrongWithAirAndGravity) {
  EXPECT_THAT(complaint([](Environment& e) { e.gravity.z() = kNaN; }),
              HasSubstr("environment: gravity is not finite"));
  EXPECT_THAT(complaint([](Environment& e) { e.air->density = -1.0; }),
              HasSubstr("air: density is -1 kg/m^3"));
}

}  // namespace
}  // namespace limber
