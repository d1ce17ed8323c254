#include "core/environment/flow_field.h"

#include <cmath>
#include <numbers>

namespace limber {
namespace {

using std::numbers::pi;

// In a plane across a line (n = 2) or in space (n = 3): what leaves the centre spreads over this
// angle.
double whole_angle(int n) { return n == 2 ? 2.0 * pi : 4.0 * pi; }

double power(double x, int p) {
  double product = 1.0;
  for (int i = 0; i < p; ++i) product *= x;
  return product;
}

Vec3 across(const Vec3& v, const Vec3& unit_axis) { return v - v.dot(unit_axis) * unit_axis; }

// Unit strength, n dimensions: unit(r) / (angle r^(n-1)).
Vec3 source(const Vec3& r, double core_radius, int n) {
  return r.normalized() * (regularised_pole(r.norm(), core_radius, n - 1, 1) / whole_angle(n));
}

// Moment m, n dimensions: (n (m . unit(r)) unit(r) - m) / (angle r^n).
Vec3 doublet(const Vec3& r, const Vec3& m, double core_radius, int n) {
  const Vec3 unit = r.normalized();
  const Vec3 shape = n * m.dot(unit) * unit - m;
  return shape * (regularised_pole(r.norm(), core_radius, n, 2) / whole_angle(n));
}

Vec3 line_source(const Vec3& r, const Vec3& unit_axis, double core_radius) {
  return source(across(r, unit_axis), core_radius, 2);
}

Vec3 line_doublet(const Vec3& r, const Vec3& unit_axis, const Vec3& moment, double core_radius) {
  return doublet(across(r, unit_axis), across(moment, unit_axis), core_radius, 2);
}

// The primitive everywhere and with strength 1. `r`: offset from its position, m.
Vec3 unit_flow(const FlowPrimitive& primitive, const Vec3& r) {
  const auto axis = [&] { return Vec3(primitive.axis.normalized()); };
  const auto direction = [&] { return Vec3(primitive.direction.normalized()); };
  switch (primitive.kind) {
    case FlowKind::kUniform:
      return direction();
    case FlowKind::kLineSource:
      return line_source(r, axis(), primitive.core_radius);
    case FlowKind::kPointSource:
      return source(r, primitive.core_radius, 3);
    case FlowKind::kLineVortex:
      return axis().cross(line_source(r, axis(), primitive.core_radius));
    case FlowKind::kLineDoublet:
      return line_doublet(r, axis(), direction(), primitive.core_radius);
    case FlowKind::kPointDoublet:
      return doublet(r, direction(), primitive.core_radius, 3);
  }
  return Vec3::Zero();
}

}  // namespace

FlowPrimitive uniform_flow(const Vec3& velocity) {
  FlowPrimitive flow;
  if (velocity.norm() > 0.0) flow.direction = velocity;
  flow.strength = velocity.norm();
  return flow;
}

double regularised_pole(double r, double core_radius, int p, int q) {
  if (r >= core_radius) return 1.0 / power(r, p);
  const double s = r / core_radius;
  return power(s, q) * (1.0 + 0.5 * (p + q) * (1.0 - s * s)) / power(core_radius, p);
}

double share_within(const FlowBounds& bounds, const Vec3& at) {
  if (std::isinf(bounds.radius)) return 1.0;
  const double beyond = (at - bounds.centre).norm() - bounds.radius;
  if (beyond <= 0.0) return 1.0;
  if (beyond >= bounds.fade) return 0.0;
  const double s = beyond / bounds.fade;
  return 1.0 - s * s * (3.0 - 2.0 * s);
}

Vec3 flow_velocity(const FlowPrimitive& primitive, const Vec3& at, double time) {
  const double share = share_within(primitive.bounds, at);
  if (share == 0.0) return Vec3::Zero();
  const Vec3 r = at - primitive.position.at(time);
  return share * primitive.strength.at(time) * unit_flow(primitive, r);
}

Vec3 flow_velocity(const FlowField& field, const Vec3& at, double time) {
  Vec3 velocity = Vec3::Zero();
  for (const FlowPrimitive& primitive : field.primitives) {
    velocity += flow_velocity(primitive, at, time);
  }
  return velocity;
}

}  // namespace limber
