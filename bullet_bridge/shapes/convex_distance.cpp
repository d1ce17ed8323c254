#include "bullet_bridge/shapes/convex_distance.h"

#include <algorithm>
#include <cmath>

#include "bullet_bridge/shapes/bullet_query.h"
#include "bullet_bridge/shapes/convex_planes.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// A body of revolution about y in its half plane: r >= 0 from the axis, and y.
using Vec2 = Eigen::Vector2d;

struct FlatPenetration {
  double depth;
  Vec2 normal;
};

FlatPenetration rectangle_penetration(const Vec2& half, const Vec2& point) {
  const Vec2 outside(point.x() - half.x(), std::abs(point.y()) - half.y());
  const double up = point.y() < 0.0 ? -1.0 : 1.0;
  if (outside.maxCoeff() <= 0.0) {
    if (outside.x() > outside.y()) return {-outside.x(), Vec2::UnitX()};
    return {-outside.y(), up * Vec2::UnitY()};
  }
  const Vec2 gap = outside.cwiseMax(0.0);
  const double distance = gap.norm();
  return {-distance, Vec2(gap.x(), up * gap.y()) / distance};
}

Vec2 nearest_on_segment(const Vec2& a, const Vec2& b, const Vec2& point) {
  const Vec2 way = b - a;
  return a + std::clamp((point - a).dot(way) / way.squaredNorm(), 0.0, 1.0) * way;
}

// The right triangle with its corners at the tip, the rim and the middle of the base.
FlatPenetration half_cone_penetration(double radius, double half_height, const Vec2& point) {
  const Vec2 tip(0.0, half_height), rim(radius, -half_height), middle(0.0, -half_height);
  const Vec2 slant = Vec2(2.0 * half_height, radius).normalized();
  const double over_slant = slant.dot(point - tip), under_base = -half_height - point.y();
  if (over_slant <= 0.0 && under_base <= 0.0) {
    if (over_slant > under_base) return {-over_slant, slant};
    return {-under_base, -Vec2::UnitY()};
  }
  const Vec2 to_side = point - nearest_on_segment(tip, rim, point);
  const Vec2 to_base = point - nearest_on_segment(middle, rim, point);
  const Vec2 gap = to_side.squaredNorm() < to_base.squaredNorm() ? to_side : to_base;
  const double distance = gap.norm();
  if (distance <= 0.0) return {0.0, over_slant > under_base ? slant : Vec2(-Vec2::UnitY())};
  return {-distance, gap / distance};
}

double from_axis(const Vec3& point) { return std::hypot(point.x(), point.z()); }

// Back from the half plane of `point`.
Penetration revolved(const FlatPenetration& flat, double margin, const Vec3& point) {
  const double r = from_axis(point);
  const Vec3 outwards = r > 0.0 ? Vec3(point.x() / r, 0.0, point.z() / r) : Vec3(Vec3::UnitX());
  return {flat.depth + margin, flat.normal.x() * outwards + flat.normal.y() * Vec3::UnitY()};
}

// The share of the way at which it is within the part's bounds; > 1 for never.
double share_into_bounds(const ContactPart& part, const Vec3& a, const Vec3& way) {
  double in = 0.0, out = 1.0;
  for (int k = 0; k < 3; ++k) {
    if (way[k] == 0.0) {
      if (a[k] < part.own_low[k] || a[k] > part.own_high[k]) return 2.0;
      continue;
    }
    const double s = (part.own_low[k] - a[k]) / way[k], t = (part.own_high[k] - a[k]) / way[k];
    in = std::max(in, std::min(s, t));
    out = std::min(out, std::max(s, t));
  }
  return in <= out ? in : 2.0;
}

}  // namespace

Penetration box_penetration(const Vec3& half_extents, const Vec3& point) {
  const Vec3 outside = point.cwiseAbs() - half_extents;
  int axis = 0;
  const double nearest = outside.maxCoeff(&axis);
  Vec3 normal = Vec3::Zero();
  if (nearest <= 0.0) {
    normal[axis] = point[axis] < 0.0 ? -1.0 : 1.0;
    return {-nearest, normal};
  }
  const Vec3 gap = outside.cwiseMax(0.0);
  const double distance = gap.norm();
  for (int i = 0; i < 3; ++i) normal[i] = (point[i] < 0.0 ? -gap[i] : gap[i]) / distance;
  return {-distance, normal};
}

Penetration sphere_penetration(double radius, const Vec3& point) {
  const double distance = point.norm();
  return {radius - distance, distance > 0.0 ? Vec3(point / distance) : Vec3(Vec3::UnitY())};
}

Penetration capsule_penetration(double radius, double half_height, const Vec3& point) {
  const Vec3 gap(point.x(), point.y() - std::clamp(point.y(), -half_height, half_height),
                 point.z());
  const double distance = gap.norm();
  return {radius - distance, distance > 0.0 ? Vec3(gap / distance) : Vec3(Vec3::UnitX())};
}

Penetration cylinder_penetration(double radius, double half_height, double margin,
                                 const Vec3& point) {
  const Vec2 flat(from_axis(point), point.y());
  return revolved(rectangle_penetration({radius, half_height}, flat), margin, point);
}

Penetration cone_penetration(double radius, double half_height, double margin, const Vec3& point) {
  const Vec2 flat(from_axis(point), point.y());
  return revolved(half_cone_penetration(radius, half_height, flat), margin, point);
}

Penetration convex_penetration(const ContactPart& part, const Vec3& point) {
  switch (part.kind) {
    case ContactPart::Kind::kBox:
      return box_penetration(part.half_extents, point);
    case ContactPart::Kind::kSphere:
      return sphere_penetration(part.radius, point);
    case ContactPart::Kind::kCapsule:
      return capsule_penetration(part.radius, part.half_height, point);
    case ContactPart::Kind::kCylinder:
      return cylinder_penetration(part.radius, part.half_height, part.margin, point);
    case ContactPart::Kind::kCone:
      return cone_penetration(part.radius, part.half_height, part.margin, point);
    case ContactPart::Kind::kHull:
      return part.hull->penetration(point, part.margin);
    default:
      return bullet_penetration(*part.convex, point);
  }
}

WayIn way_into(const ContactPart& part, const Vec3& a, const Vec3& b) {
  constexpr int kMostSteps = 64;
  if (part.kind == ContactPart::Kind::kHull && part.hull->parted_from(a, b, part.margin)) return {};
  const Vec3 way = b - a;
  const double tolerance = part.tolerance + 1e-12 * way.cwiseAbs().maxCoeff();
  WayIn in{false, share_into_bounds(part, a, way), Vec3::Zero()};
  for (int step = 0; step < kMostSteps && in.share <= 1.0; ++step) {
    const Penetration at = convex_penetration(part, a + in.share * way);
    in.normal = at.normal;
    in.enters = at.depth >= -tolerance;
    const double approach = -at.normal.dot(way);
    if (in.enters || approach <= 0.0) return in;
    in.share += -at.depth / approach;
  }
  // A way that has not parted from the surface after so many steps touches it.
  in.enters = in.share <= 1.0;
  return in;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
