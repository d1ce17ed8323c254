#include "core/environment/rigid_flight.h"

#include <algorithm>
#include <cmath>

#include "core/environment/face_drag.h"

namespace limber {
namespace {

constexpr double kTurnPerStep = 0.05;  // rad
constexpr double kDragPerStep = 0.5;   // of the time in which drag slows the body down by 1/e
constexpr double kMostSteps = 1000.0;  // a leaf of 0.1 g in a storm needs a dozen

// Derivative of a FlightState; the orientation's as a quaternion that is not normalised.
struct Slope {
  Vec3 velocity;
  Eigen::Vector4d orientation;  // x y z w
  Vec3 acceleration;
  Vec3 torque;
};

BodyMotion motion_of(const FlyingBody& body, const FlightState& state) {
  return {state.centre, state.orientation.toRotationMatrix(), state.velocity,
          angular_velocity(body, state)};
}

Slope slope_of(const FlyingBody& body, const Air& air, const Vec3& gravity, double time,
               const FlightState& state) {
  const BodyMotion motion = motion_of(body, state);
  const Wrench wrench = rigid_face_wrench(body.faces, motion, air, time);
  const Vec3 half = 0.5 * motion.angular_velocity;
  const Eigen::Quaterniond turning =
      Eigen::Quaterniond(0.0, half.x(), half.y(), half.z()) * state.orientation;
  return {state.velocity, turning.coeffs(), gravity + wrench.force / body.mass, wrench.torque};
}

FlightState moved(const FlightState& from, const Slope& slope, double dt) {
  FlightState to;
  to.centre = from.centre + dt * slope.velocity;
  to.orientation =
      Eigen::Quaterniond(Eigen::Vector4d(from.orientation.coeffs() + dt * slope.orientation))
          .normalized();
  to.velocity = from.velocity + dt * slope.acceleration;
  to.angular_momentum = from.angular_momentum + dt * slope.torque;
  return to;
}

Slope mean_slope(const Slope& a, const Slope& b, const Slope& c, const Slope& d) {
  const auto mean = [](const auto& p, const auto& q, const auto& r, const auto& s) {
    return ((p + 2.0 * q + 2.0 * r + s) / 6.0).eval();
  };
  return {mean(a.velocity, b.velocity, c.velocity, d.velocity),
          mean(a.orientation, b.orientation, c.orientation, d.orientation),
          mean(a.acceleration, b.acceleration, c.acceleration, d.acceleration),
          mean(a.torque, b.torque, c.torque, d.torque)};
}

// Upper estimate of how fast drag slows the body down, 1/s: every force is at most quadratic in the
// relative wind u, so that dF/du is at most 2 F / u, and a face at r acts on the rotation with r^2.
double drag_rate(const FlyingBody& body, const Air& air, double time, const FlightState& state) {
  const BodyMotion motion = motion_of(body, state);
  const double lightest = body.moments.minCoeff();
  double rate = 0.0;
  for (const BodyFace& face : body.faces) {
    const Vec3 arm = motion.rotation * face.centroid;
    const Vec3 velocity = motion.velocity + motion.angular_velocity.cross(arm);
    const Vec3 wind = flow_velocity(air.wind, motion.centre + arm, time) - velocity;
    const double speed = wind.norm();
    if (speed == 0.0) continue;
    const Vec3 area = motion.rotation * face.area_vector;
    const double per_speed = face_drag(face.attributes, area, wind, air.density).norm() / speed;
    rate += 2.0 * per_speed * (1.0 / body.mass + arm.squaredNorm() / lightest);
  }
  return rate;
}

}  // namespace

Vec3 angular_velocity(const FlyingBody& body, const FlightState& state) {
  const Vec3 momentum = state.orientation.conjugate() * state.angular_momentum;
  return state.orientation * Vec3(momentum.cwiseQuotient(body.moments));
}

FlightState flown(const FlyingBody& body, const Air& air, const Vec3& gravity, double time,
                  double dt, const FlightState& start) {
  const double turns = angular_velocity(body, start).norm() * dt / kTurnPerStep;
  FlightState falling = start;  // as fast as gravity may make it
  falling.velocity += gravity * dt;
  const double rate =
      std::max(drag_rate(body, air, time, start), drag_rate(body, air, time, falling));
  const double slowing = rate * dt / kDragPerStep;
  const double steps = std::ceil(std::clamp(std::max(turns, slowing), 1.0, kMostSteps));
  const double h = dt / steps;
  FlightState state = start;
  for (int i = 0; i < static_cast<int>(steps); ++i) {
    const double t = time + i * h;
    const Slope a = slope_of(body, air, gravity, t, state);
    const Slope b = slope_of(body, air, gravity, t + 0.5 * h, moved(state, a, 0.5 * h));
    const Slope c = slope_of(body, air, gravity, t + 0.5 * h, moved(state, b, 0.5 * h));
    const Slope d = slope_of(body, air, gravity, t + h, moved(state, c, h));
    state = moved(state, mean_slope(a, b, c, d), h);
  }
  return state;
}

}  // namespace limber
