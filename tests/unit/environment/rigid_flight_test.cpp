#include "core/environment/rigid_flight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/dynamics/free_rotation.h"

namespace limber {
namespace {

const Vec3 kGravity(0.0, -9.81, 0.0);

// A plate of 0.04 m^2 in the x-z plane, 50 g.
FlyingBody plate(double normal_drag, double tangential_drag) {
  const FaceAttributes paper{.normal_drag = normal_drag, .tangential_drag = tangential_drag};
  FlyingBody body{.mass = 0.05, .moments = {1e-4, 2e-4, 1.2e-4}};
  body.faces.push_back(body_face({Vec3(-0.1, 0.0, -0.1), {-0.1, 0.0, 0.1}, {0.1, 0.0, 0.1}}, paper));
  body.faces.push_back(body_face({Vec3(-0.1, 0.0, -0.1), {0.1, 0.0, 0.1}, {0.1, 0.0, -0.1}}, paper));
  return body;
}

TEST(RigidFlight, WithoutFacesIsAParabolaAndAFreeRotation) {
  const FlyingBody body{.mass = 2.0, .moments = {1.0, 2.0, 3.0}};
  FlightState start;
  start.velocity = {1.0, 2.0, 3.0};
  start.angular_momentum = {0.5, 6.0, 1.0};
  const double t = 0.3;
  const FlightState end = flown(body, Air{}, kGravity, 0.0, t, start);
  EXPECT_LT((end.centre - (start.velocity * t + 0.5 * t * t * kGravity)).norm(), 1e-14);
  EXPECT_EQ(end.angular_momentum, start.angular_momentum);
  Eigen::Quaterniond orientation = start.orientation;
  Vec3 omega = angular_velocity(body, start);
  rotate_freely(orientation, omega, body.moments, t);
  EXPECT_LT(orientation.angularDistance(end.orientation), 1e-6);
  EXPECT_LT((angular_velocity(body, end) - omega).norm(), 1e-5);
}

// m v' = m g - rho A C v^2 / 2: v = v_t tanh(g t / v_t).
TEST(RigidFlight, FaceOnFallsAsTheClosedForm) {
  const FlyingBody body = plate(1.2, 0.0);
  const Air air;
  const double terminal = std::sqrt(2.0 * 0.05 * 9.81 / (air.density * 0.04 * 1.2));
  const FlightState end = flown(body, air, kGravity, 0.0, 0.5, {});
  EXPECT_NEAR(end.velocity.y(), -terminal * std::tanh(9.81 * 0.5 / terminal), 1e-5 * terminal);
  EXPECT_NEAR(end.centre.y(),
              -terminal * terminal / 9.81 * std::log(std::cosh(9.81 * 0.5 / terminal)), 1e-5);
  EXPECT_LT(end.orientation.angularDistance(Eigen::Quaterniond::Identity()), 1e-12);
}

// One call over a tick and many over its parts agree: what the steps are chosen by suffices.
TEST(RigidFlight, OfATumblingPlateDoesNotHangOnTheCallsItIsMadeOf) {
  const FlyingBody body = plate(1.5, 0.1);
  Air air;
  air.wind.primitives = {uniform_flow({6.0, 1.0, -2.0})};
  FlightState start;
  start.angular_momentum = {2e-3, 1e-3, -1e-3};
  const FlightState once = flown(body, air, kGravity, 0.0, 0.1, start);
  FlightState often = start;
  for (int i = 0; i < 200; ++i) often = flown(body, air, kGravity, i * 5e-4, 5e-4, often);
  EXPECT_LT((once.centre - often.centre).norm(), 1e-5);
  EXPECT_LT((once.velocity - often.velocity).norm(), 1e-3);
  EXPECT_LT(once.orientation.angularDistance(often.orientation), 1e-4);
}

// A film so light that drag stops it within a hundredth of the step.
TEST(RigidFlight, StaysStableWhereDragIsFarFasterThanTheStep) {
  FlyingBody film = plate(1.2, 0.1);
  film.mass = 1e-4;
  film.moments *= 2e-3;
  Air air;
  air.wind.primitives = {uniform_flow({10.0, 0.0, 0.0})};
  FlightState state;
  state.velocity = {0.0, 20.0, 0.0};
  const FlightState end = flown(film, air, kGravity, 0.0, 1.0 / 60.0, state);
  EXPECT_LT(end.velocity.norm(), 11.0);
}

}  // namespace
}  // namespace limber
