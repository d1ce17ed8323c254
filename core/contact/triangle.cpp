#include "core/contact/triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber {
namespace {

// Is the corner nearer than all of the two sides that meet there?
bool is_beyond_corner(const Vec3& point, const Triangle& t, int i) {
  const Vec3 way = point - t[i];
  const Vec3 next = t[(i + 1) % 3] - t[i], last = t[(i + 2) % 3] - t[i];
  return next.dot(way) <= 0.0 && last.dot(way) <= 0.0;
}

// Barycentric, of the projection on the triangle's plane: areas of the parts towards the other two
// corners. Zero for a triangle without area. Differences have names because Eigen would build a
// nested one anew for each component of a cross product, five times the work.
Vec3 weights_of_projection(const Vec3& point, const Triangle& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = point - t[0];
  const Vec3 normal = ab.cross(ac);
  const double squared = normal.squaredNorm();
  if (squared == 0.0) return Vec3::Zero();
  const double wb = normal.dot(ap.cross(ac)) / squared;
  const double wc = normal.dot(ab.cross(ap)) / squared;
  return {1.0 - wb - wc, wb, wc};
}

// Nearest point of the side from corner i to corner j.
NearestPoint nearest_on_side(const Vec3& point, const Triangle& t, int i, int j) {
  const Vec3 side = t[j] - t[i], way = point - t[i];
  const double squared = side.squaredNorm();
  const double along = squared > 0.0 ? std::clamp(way.dot(side) / squared, 0.0, 1.0) : 0.0;
  Vec3 weights = Vec3::Zero();
  weights[i] = 1.0 - along;
  weights[j] = along;
  return {weights, (point - point_at(t, weights)).squaredNorm()};
}

// The cubic c0 + c1 t + c2 t^2 + c3 t^3.
struct Cubic {
  double c0, c1, c2, c3;
  double operator()(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
};

// signed_volume() as all four points move evenly.
Cubic volume_over_time(const Vec3& point_from, const Vec3& point_to, const Triangle& from,
                       const Triangle& to) {
  const Vec3 r0 = point_from - from[0], r1 = point_to - to[0] - r0;
  const Vec3 u0 = from[1] - from[0], u1 = to[1] - to[0] - u0;
  const Vec3 v0 = from[2] - from[0], v1 = to[2] - to[0] - v0;
  const Vec3 n0 = u0.cross(v0), n1 = u0.cross(v1) + u1.cross(v0), n2 = u1.cross(v1);
  return {r0.dot(n0), r0.dot(n1) + r1.dot(n0), r0.dot(n2) + r1.dot(n1), r1.dot(n2)};
}

// Is it of one sign from 0 to 1 for certain? A cubic lies within the hull of its Bernstein
// coefficients.
bool keeps_its_sign(const Cubic& f) {
  const std::array<double, 4> hull = {f.c0, f.c0 + f.c1 / 3.0, f.c0 + (2.0 * f.c1 + f.c2) / 3.0,
                                      f.c0 + f.c1 + f.c2 + f.c3};
  return *std::min_element(hull.begin(), hull.end()) > 0.0 ||
         *std::max_element(hull.begin(), hull.end()) < 0.0;
}

// 0, the extrema between 0 and 1 in order, 1. Returns how many.
int monotone_parts(const Cubic& f, std::array<double, 4>& ends) {
  ends = {0.0, 1.0, 1.0, 1.0};
  int count = 1;
  // 3 c3 t^2 + 2 c2 t + c1 = 0, without cancellation; a root that is not finite is none.
  const double square = f.c2 * f.c2 - 3.0 * f.c3 * f.c1;
  if (square > 0.0) {
    const double q = -(f.c2 + std::copysign(std::sqrt(square), f.c2));
    std::array<double, 2> roots = {q / (3.0 * f.c3), f.c1 / q};
    if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
    for (double root : roots) {
      if (root > 0.0 && root < 1.0) ends[count++] = root;
    }
  }
  ends[count++] = 1.0;
  return count;
}

// Where f changes from `before` at `low` to the other side at `high`: halved until nothing lies
// between the two.
double root_between(const Cubic& f, double low, double high, bool before) {
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return high;
    ((f(middle) >= 0.0) == before ? low : high) = middle;
  }
}

bool passes_within(double t, const Vec3& point_from, const Vec3& point_to, const Triangle& from,
                   const Triangle& to) {
  Triangle then;
  for (int i = 0; i < 3; ++i) then[i] = from[i] + t * (to[i] - from[i]);
  const Vec3 point = point_from + t * (point_to - point_from);
  const double size = (then[1] - then[0]).norm() + (then[2] - then[0]).norm();
  const double seam = kSeamShare * size;
  return nearest_on_triangle(point, then).squared_distance <= seam * seam;
}

}  // namespace

NearestPoint nearest_on_triangle(const Vec3& point, const Triangle& t) {
  for (int i = 0; i < 3; ++i) {
    if (is_beyond_corner(point, t, i)) return {Vec3::Unit(i), (point - t[i]).squaredNorm()};
  }
  const Vec3 weights = weights_of_projection(point, t);
  if (weights[0] > 0.0 && weights[1] > 0.0 && weights[2] > 0.0) {
    return {weights, (point - point_at(t, weights)).squaredNorm()};
  }
  NearestPoint nearest{Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (int i = 0; i < 3; ++i) {
    if (weights[(i + 2) % 3] > 0.0) continue;
    const NearestPoint other = nearest_on_side(point, t, i, (i + 1) % 3);
    if (other.squared_distance < nearest.squared_distance) nearest = other;
  }
  return nearest;
}

bool line_passes(const Triangle& triangle, const Vec3& a, const Vec3& b) {
  constexpr double kHair = 1e-12;  // of the triangle's distance: some thousand roundings
  const Vec3 way = b - a;
  const Vec3 u = triangle[0] - a, v = triangle[1] - a, w = triangle[2] - a;
  // Six times the volumes of the tetrahedra over the way and each side.
  const double on_0 = way.dot(u.cross(v)), on_1 = way.dot(v.cross(w)), on_2 = way.dot(w.cross(u));
  const double hair = kHair * way.norm() * (u.squaredNorm() + v.squaredNorm() + w.squaredNorm());
  return (on_0 >= -hair && on_1 >= -hair && on_2 >= -hair) ||
         (on_0 <= hair && on_1 <= hair && on_2 <= hair);
}

std::array<Vec3, 3> weight_gradients(const Triangle& t) {
  const Vec3 normal = twice_area_vector(t);
  const double squared = normal.squaredNorm();
  std::array<Vec3, 3> gradients;
  gradients.fill(Vec3::Zero());
  if (squared == 0.0) return gradients;
  for (int i = 0; i < 3; ++i) {
    gradients[i] = normal.cross(t[(i + 2) % 3] - t[(i + 1) % 3]) / squared;
  }
  return gradients;
}

Crossings crossings(const Vec3& point_from, const Vec3& point_to, const Triangle& from,
                    const Triangle& to) {
  Crossings found;
  const Cubic volume = volume_over_time(point_from, point_to, from, to);
  bool before = is_before(point_from, from);
  if (keeps_its_sign(volume) && is_before(point_to, to) == before) return found;
  std::array<double, 4> ends;
  const int count = monotone_parts(volume, ends);
  for (int i = 1; i < count; ++i) {
    const bool then = i + 1 < count ? volume(ends[i]) >= 0.0 : is_before(point_to, to);
    if (then == before) continue;
    const double t = root_between(volume, ends[i - 1], ends[i], before);
    if (passes_within(t, point_from, point_to, from, to)) found.at[found.count++] = {t, before};
    before = then;
  }
  return found;
}

}  // namespace limber
