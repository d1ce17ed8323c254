#include "bullet_bridge/shapes/triangle.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

TriangleFoot foot_on_triangle(const Corners& triangle, const Vec3& point) {
  const auto& [a, b, c] = triangle;
  const Vec3 ab = b - a, ac = c - a, ap = point - a, bp = point - b, cp = point - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, 0b101};
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {b, 0b011};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + d1 / (d1 - d3) * ab, 0b001};
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {c, 0b110};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + d2 / (d2 - d6) * ac, 0b100};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 0b010};
  }
  const double sum = va + vb + vc;
  return {a + vb / sum * ab + vc / sum * ac, 0};
}

bool line_passes(const Corners& triangle, const Vec3& a, const Vec3& b) {
  constexpr double kHair = 1e-12;  // of the triangle's distance: some thousand roundings
  const Vec3 way = b - a;
  const Vec3 u = triangle[0] - a, v = triangle[1] - a, w = triangle[2] - a;
  // Six times the volumes of the tetrahedra over the way and each edge.
  const double on_0 = way.dot(u.cross(v)), on_1 = way.dot(v.cross(w)), on_2 = way.dot(w.cross(u));
  const double hair = kHair * way.norm() * (u.squaredNorm() + v.squaredNorm() + w.squaredNorm());
  return (on_0 >= -hair && on_1 >= -hair && on_2 >= -hair) ||
         (on_0 <= hair && on_1 <= hair && on_2 <= hair);
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
