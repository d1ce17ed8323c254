#include "tests/contact_scenes/true_shape.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bullet_bridge/conversions.h"

namespace limber::bullet::test {
namespace {

constexpr double kOutside = -1e300;  // m

double in_box(const btBoxShape& box, const Vec3& p) {
  return (from_bullet(box.getHalfExtentsWithMargin()) - p.cwiseAbs()).minCoeff();
}

double in_capsule(const btCapsuleShape& capsule, const Vec3& p) {
  const double half = capsule.getHalfHeight();
  const Vec3 on_axis(0.0, std::clamp(p.y(), -half, half), 0.0);
  return capsule.getRadius() - (p - on_axis).norm();
}

double in_cylinder(const btCylinderShape& cylinder, const Vec3& p) {
  const Vec3 half = from_bullet(cylinder.getHalfExtentsWithMargin());
  return std::min(half.x() - std::hypot(p.x(), p.z()), half.y() - std::abs(p.y()));
}

// The apex is at half the height above the origin, the base as far below.
double in_cone(const btConeShape& cone, const Vec3& p) {
  const double height = cone.getHeight(), radius = cone.getRadius();
  const double from_axis = std::hypot(p.x(), p.z());
  const double below_apex = 0.5 * height - p.y();
  const double from_side = (below_apex * radius - from_axis * height) / std::hypot(height, radius);
  return std::min(from_side, height - below_apex);
}

// Every plane through three of the points that has all others on one side.
double in_hull(const btConvexHullShape& hull, const Vec3& p) {
  std::vector<Vec3> corners;
  for (int i = 0; i < hull.getNumPoints(); ++i)
    corners.push_back(from_bullet(hull.getScaledPoint(i)));
  double depth = -kOutside;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = 0; j < corners.size(); ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Vec3 normal = (corners[j] - corners[i]).cross(corners[k] - corners[i]);
        if (normal.norm() == 0.0) continue;
        const Vec3 n = normal.normalized();
        const auto above = [&](const Vec3& c) { return n.dot(c - corners[i]) > 1e-6; };
        if (std::any_of(corners.begin(), corners.end(), above)) continue;
        depth = std::min(depth, -n.dot(p - corners[i]));
      }
    }
  }
  return depth;
}

double in_compound(const btCompoundShape& compound, const Vec3& p) {
  double depth = kOutside;
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    const btTransform& pose = compound.getChildTransform(i);
    const Vec3 local =
        from_bullet(pose.getRotation()).conjugate() * (p - from_bullet(pose.getOrigin()));
    depth = std::max(depth, depth_inside(*compound.getChildShape(i), local));
  }
  return depth;
}

struct TrianglesOver : btTriangleCallback {
  explicit TrianglesOver(const Vec3& point) : p(point) {}
  void processTriangle(btVector3* corners, int, int) override {
    const Vec3 a = from_bullet(corners[0]), b = from_bullet(corners[1]),
               c = from_bullet(corners[2]);
    const Vec3 n = (b - a).cross(c - a).normalized();
    const auto turn = [&](const Vec3& from, const Vec3& to) {
      return (to.z() - from.z()) * (p.x() - from.x()) - (to.x() - from.x()) * (p.z() - from.z());
    };
    const double sides[] = {turn(a, b), turn(b, c), turn(c, a)};
    const auto [least, most] = std::minmax_element(sides, sides + 3);
    if (*least < 0.0 && *most > 0.0) return;
    depth = std::max(depth, -n.dot(p - a) * (n.y() > 0.0 ? 1.0 : -1.0));
  }
  Vec3 p;
  double depth = kOutside;
};

double under_floor(const btConcaveShape& floor, const Vec3& p) {
  constexpr double kDeep = 5.0;  // m
  TrianglesOver over(p);
  floor.processAllTriangles(&over, to_bullet(p - Vec3(1e-3, 0.1, 1e-3)),
                            to_bullet(p + Vec3(1e-3, kDeep, 1e-3)));
  return over.depth;
}

std::vector<Vec3> along(const Vec3& a, const Vec3& b, double spacing) {
  const int n = std::max(1, int(std::ceil((b - a).norm() / spacing)));
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i) points.push_back(a + (b - a) * (double(i) / n));
  return points;
}

void append(std::vector<Vec3>& all, const std::vector<Vec3>& more,
            const Vec3& shift = Vec3::Zero()) {
  for (const Vec3& p : more) all.push_back(p + shift);
}

std::vector<Vec3> box_probes(const Vec3& half, double spacing) {
  std::vector<Vec3> probes;
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Vec3 a = half;
      a[(axis + 1) % 3] *= corner & 1 ? 1.0 : -1.0;
      a[(axis + 2) % 3] *= corner & 2 ? 1.0 : -1.0;
      Vec3 b = a;
      b[axis] = -a[axis];
      append(probes, along(a, b, spacing));
    }
  }
  return probes;
}

// Extreme in 26 directions: of a sphere its surface, of a hull its corners.
std::vector<Vec3> extreme_points(const btConvexShape& shape) {
  std::vector<Vec3> probes = {Vec3::Zero()};
  for (int code = 0; code < 27; ++code) {
    const Vec3 direction(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    if (direction.norm() == 0.0) continue;
    probes.push_back(
        from_bullet(shape.localGetSupportingVertex(to_bullet(Vec3(direction.normalized())))));
  }
  return probes;
}

std::vector<Vec3> rod_probes(const btConvexShape& shape, double half_length, double spacing) {
  std::vector<Vec3> probes = extreme_points(shape);
  append(probes, along({0, -half_length, 0}, {0, half_length, 0}, spacing));
  return probes;
}

std::vector<Vec3> compound_probes(const btCompoundShape& compound, double spacing) {
  std::vector<Vec3> probes;
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    const btTransform& pose = compound.getChildTransform(i);
    for (const Vec3& p : probes_of(*compound.getChildShape(i), spacing)) {
      probes.push_back(from_bullet(pose.getRotation()) * p + from_bullet(pose.getOrigin()));
    }
  }
  return probes;
}

}  // namespace

double depth_inside(const btCollisionShape& shape, const Vec3& p) {
  if (shape.isConcave()) return under_floor(static_cast<const btConcaveShape&>(shape), p);
  switch (shape.getShapeType()) {
    case BOX_SHAPE_PROXYTYPE:
      return in_box(static_cast<const btBoxShape&>(shape), p);
    case SPHERE_SHAPE_PROXYTYPE:
      return static_cast<const btSphereShape&>(shape).getRadius() - p.norm();
    case CAPSULE_SHAPE_PROXYTYPE:
      return in_capsule(static_cast<const btCapsuleShape&>(shape), p);
    case CYLINDER_SHAPE_PROXYTYPE:
      return in_cylinder(static_cast<const btCylinderShape&>(shape), p);
    case CONE_SHAPE_PROXYTYPE:
      return in_cone(static_cast<const btConeShape&>(shape), p);
    case CONVEX_HULL_SHAPE_PROXYTYPE:
      return in_hull(static_cast<const btConvexHullShape&>(shape), p);
    case COMPOUND_SHAPE_PROXYTYPE:
      return in_compound(static_cast<const btCompoundShape&>(shape), p);
    default:
      throw std::invalid_argument("no closed form for this shape");
  }
}

std::vector<Vec3> probes_of(const btCollisionShape& shape, double spacing) {
  switch (shape.getShapeType()) {
    case BOX_SHAPE_PROXYTYPE:
      return box_probes(
          from_bullet(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin()), spacing);
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      return rod_probes(capsule, capsule.getHalfHeight(), spacing);
    }
    case CYLINDER_SHAPE_PROXYTYPE: {
      const auto& cylinder = static_cast<const btCylinderShape&>(shape);
      return rod_probes(cylinder, cylinder.getHalfExtentsWithMargin().y(), spacing);
    }
    case COMPOUND_SHAPE_PROXYTYPE:
      return compound_probes(static_cast<const btCompoundShape&>(shape), spacing);
    default:
      break;
  }
  if (!shape.isConvex()) return {};
  return extreme_points(static_cast<const btConvexShape&>(shape));
}

}  // namespace limber::bullet::test
