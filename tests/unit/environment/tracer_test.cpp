#include "core/environment/tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limber {
namespace {

using std::numbers::pi;

FlowField only(const FlowPrimitive& primitive) { return {{primitive}}; }

FlowField line(FlowKind kind, double strength) {
  FlowPrimitive primitive;
  primitive.kind = kind;
  primitive.strength = strength;
  return only(primitive);
}

Vec3 after(const FlowField& field, Vec3 at, double duration, int steps) {
  const double dt = duration / steps;
  for (int n = 0; n < steps; ++n) at = drifted(field, at, n * dt, dt);
  return at;
}

// A vortex of circulation G takes its air round a circle of radius r in 4 pi^2 r^2 / G.
TEST(Tracer, GoesRoundAVortexInItsPeriod) {
  const double radius = 0.7, circulation = 2.0;
  const Vec3 start(radius, 0.0, 0.4);
  const double period = 4.0 * pi * pi * radius * radius / circulation;
  const FlowField vortex = line(FlowKind::kLineVortex, circulation);
  EXPECT_LE((after(vortex, start, period, 400) - start).norm(), 1e-7);
  const Vec3 quarter = after(vortex, start, 0.25 * period, 100);
  EXPECT_LE((quarter - Vec3(0.0, radius, 0.4)).norm(), 1e-7);
}

// r dr/dt = Q / (2 pi): r^2 = r0^2 + Q t / pi. The error falls with the fourth power of the step.
TEST(Tracer, LeavesASourceWithFourthOrder) {
  const double outflow = 2.0, duration = 3.0;
  const Vec3 start(0.3, 0.4, -1.0);
  const double r = std::sqrt(0.25 + outflow * duration / pi);
  const Vec3 wanted(0.6 * r, 0.8 * r, -1.0);
  const FlowField source = line(FlowKind::kLineSource, outflow);
  const auto error = [&](int steps) {
    return (after(source, start, duration, steps) - wanted).norm();
  };
  EXPECT_LE(error(1000), 1e-10);
  EXPECT_NEAR(error(40) / error(80), 16.0, 3.0);
}

// Uniform flow that grows with time as a t: x = a t^2 / 2, exactly, because the rule is Simpson's.
TEST(Tracer, FollowsAFlowThatChanges) {
  FlowPrimitive rising = uniform_flow({1.0, 0.0, 0.0});
  rising.strength = Track<double>({{0.0, 0.0}, {2.0, 6.0}});
  EXPECT_LE((after(only(rising), Vec3::Zero(), 2.0, 1) - Vec3(6.0, 0.0, 0.0)).norm(), 1e-14);
}

}  // namespace
}  // namespace limber
