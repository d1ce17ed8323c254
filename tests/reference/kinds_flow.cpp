// Group 6: flow fields, and particles that drift with them.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/environment/tracer.h"
#include "tests/reference/flow.h"
#include "tests/reference/kinds.h"

namespace limber::reference {
namespace {

using std::numbers::pi;

// ---- the field ---------------------------------------------------------------------------------

// dv_i / dx_j, 1/s, by central differences of fourth order.
Mat3 velocity_gradient(const FlowField& field, const Vec3& at) {
  const double h = 1e-3;  // m: rounding and truncation both stay near 1e-10 of the velocity
  Mat3 gradient;
  for (int j = 0; j < 3; ++j) {
    const auto v = [&](double x) -> Vec3 {
      return flow_velocity(field, at + x * Vec3::Unit(j), 0);
    };
    gradient.col(j) = (8.0 * (v(h) - v(-h)) - (v(2.0 * h) - v(-2.0 * h))) / (12.0 * h);
  }
  return gradient;
}

double largest_divergence_or_curl(const FlowField& field, const std::vector<Vec3>& points) {
  double largest = 0.0;
  for (const Vec3& at : points) {
    const Mat3 gradient = velocity_gradient(field, at);
    const Mat3 twice_spin = gradient - gradient.transpose();
    largest = std::max({largest, std::abs(gradient.trace()), twice_spin.cwiseAbs().maxCoeff()});
  }
  return largest;
}

Json flow_field(const Case& c) {
  const FlowField field = flow_of(c.params.at("primitives"));
  std::vector<Vec3> points, velocities;
  for (const Json& point : c.params.at("points")) points.push_back(vec3(point));
  for (const Vec3& at : points) velocities.push_back(flow_velocity(field, at, 0.0));
  return {{"velocity", to_json(velocities)},
          {"divergence_and_curl", largest_divergence_or_curl(field, points)}};
}

// ---- a tracer ----------------------------------------------------------------------------------

// How far a tracer turns or is stretched in one step.
constexpr double kShareOfTurn = 2e-3;

double tracer_step(const FlowField& field, const Vec3& at) {
  return kShareOfTurn / velocity_gradient(field, at).norm();
}

Vec3 traced(const FlowField& field, Vec3 at, double from, double to) {
  double time = from;
  while (time < to) {
    const double left = to - time;
    const double dt = left / std::max(1.0, std::ceil(left / tracer_step(field, at)));
    at = drifted(field, at, time, dt);
    time = left - dt < 1e-12 * dt ? to : time + dt;
  }
  return at;
}

// The time after which a tracer passes its start again, s: when it next comes through the plane
// across its first velocity from behind. Newton's method within the step.
double return_time(const FlowField& field, const Vec3& start) {
  const Vec3 ahead = flow_velocity(field, start, 0.0);
  const auto passed = [&](const Vec3& x) { return (x - start).dot(ahead); };
  Vec3 at = start;
  double time = 0.0, was = 0.0;
  for (int n = 0; n < 10'000'000; ++n) {
    const double dt = tracer_step(field, at);
    const Vec3 next = drifted(field, at, time, dt);
    if (was < 0.0 && passed(next) >= 0.0) break;
    was = passed(next);
    at = next;
    time += dt;
  }
  double within = 0.0;
  for (int n = 0; n < 20; ++n) {
    const Vec3 x = drifted(field, at, time, within);
    within -= passed(x) / flow_velocity(field, x, time + within).dot(ahead);
  }
  return time + within;
}

double distance_from_axis(const FlowPrimitive& primitive, const Vec3& at) {
  return primitive.axis.normalized().cross(at - primitive.position.at(0.0)).norm();
}

bool has(const FlowField& field, FlowKind kind) {
  return std::any_of(field.primitives.begin(), field.primitives.end(),
                     [&](const FlowPrimitive& p) { return p.kind == kind; });
}

Json tracer(const Case& c) {
  const FlowField field = flow_of(c.params.at("primitives"));
  const Vec3 start = vec3(c.params.at("x0"));
  Vec3 at = start;
  double time = 0.0;
  std::vector<Vec3> x;
  Json r = Json::array();
  for (double sample : c.inputs.at("t")) {
    at = traced(field, at, time, sample);
    time = sample;
    x.push_back(at);
    r.push_back(distance_from_axis(field.primitives.front(), at));
  }
  Json result = {{"x", to_json(x)}, {"r", r}};
  // Around a vortex alone the tracer comes back.
  if (field.primitives.size() == 1 && has(field, FlowKind::kLineVortex)) {
    result["orbit_period"] = return_time(field, start);
  }
  return result;
}

// ---- a half-body: uniform flow and a line source -----------------------------------------------

// The plane across the source's axis: x along the uniform flow, from the source.
struct HalfBody {
  FlowField field;
  Vec3 origin, along, across;

  Vec3 at(double x, double y) const { return origin + x * along + y * across; }
  Vec3 velocity(double x, double y) const { return flow_velocity(field, at(x, y), 0.0); }
};

HalfBody half_body_of(const Json& primitives) {
  HalfBody body;
  body.field = flow_of(primitives);
  for (const FlowPrimitive& p : body.field.primitives) {
    if (p.kind == FlowKind::kUniform) body.along = p.direction.normalized();
  }
  for (const FlowPrimitive& p : body.field.primitives) {
    if (p.kind != FlowKind::kLineSource) continue;
    body.origin = p.position.at(0.0);
    body.across = p.axis.normalized().cross(body.along);
  }
  return body;
}

// Where a function that rises from below zero to above passes zero, to the last digit.
double root_between(double low, double high, const std::function<double(double)>& f) {
  for (int n = 0; n < 200 && low < high; ++n) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (f(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// By Gauss' rule of five points on 200 intervals.
double integral(double from, double to, const std::function<double(double)>& f) {
  constexpr double kNode[] = {0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr double kWeight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  constexpr int kIntervals = 200;
  const double half = 0.5 * (to - from) / kIntervals;
  double sum = 0.0;
  for (int i = 0; i < kIntervals; ++i) {
    const double middle = from + (2 * i + 1) * half;
    sum += kWeight[0] * f(middle);
    for (int n = 1; n < 3; ++n) {
      sum += kWeight[n] * (f(middle - kNode[n] * half) + f(middle + kNode[n] * half));
    }
  }
  return sum * half;
}

// What flows, per length of the source, between the stagnation point at (x, 0) and (0, y): up to
// (x, y), then along to (0, y). It is zero where the dividing streamline goes through (0, y).
double flow_between(const HalfBody& body, double x, double y) {
  const auto past_first = [&](double s) { return body.velocity(x, s).dot(body.along); };
  const auto past_second = [&](double s) { return body.velocity(s, y).dot(body.across); };
  return integral(0.0, y, past_first) - integral(x, 0.0, past_second);
}

// What the source gives out, m^2/s: through a circle around it.
double outflow(const HalfBody& body, double radius) {
  constexpr int kPoints = 64;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * pi * i / kPoints;
    const double x = std::cos(angle), y = std::sin(angle);
    sum += body.velocity(radius * x, radius * y).dot(x * body.along + y * body.across);
  }
  return sum * 2.0 * pi * radius / kPoints;
}

Json rankine_half_body(const Case& c) {
  const HalfBody body = half_body_of(c.params.at("primitives"));
  const double far = 1e16;  // m: the source is not felt there, not even in the last digit
  const double nearest = 1e-5;
  const double ahead =
      root_between(nearest, far, [&](double s) { return body.velocity(-s, 0.0).dot(body.along); });
  const double width = root_between(1e-3 * ahead, 100.0 * ahead,
                                    [&](double y) { return flow_between(body, -ahead, y); });
  // Far downstream both halves of what the source gave out fill the body at the speed there.
  const double half_width = 0.5 * outflow(body, ahead) / body.velocity(far, 0.0).norm();
  return {{"stagnation_point", to_json(body.at(-ahead, 0.0))},
          {"velocity_at_stagnation", to_json(body.velocity(-ahead, 0.0))},
          {"half_width_at_x0", width},
          {"speed_at_x0_on_body", body.velocity(0.0, width).norm()},
          {"half_width_infinity", half_width}};
}

}  // namespace

Kinds flow_kinds() {
  return {{"flow_field", flow_field}, {"tracer", tracer}, {"rankine_half_body", rankine_half_body}};
}

}  // namespace limber::reference
