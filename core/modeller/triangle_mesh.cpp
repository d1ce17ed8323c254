#include "core/modeller/triangle_mesh.h"

#include "core/model/bounds.h"

namespace limber {
namespace {

std::array<Vec3, 3> corners_from(const TriangleMesh& mesh, const MeshTriangle& t,
                                 const Vec3& origin) {
  return {mesh.positions[t[0]] - origin, mesh.positions[t[1]] - origin,
          mesh.positions[t[2]] - origin};
}

// The tetrahedron (0, a, b, c), signed: over it, with D = a . (b x c) and s = a + b + c,
// int 1 = D / 6, int x = D s / 24, int x x^T = D (a a^T + b b^T + c c^T + s s^T) / 120.
void add_tetrahedron(MomentSums& sums, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const double determinant = a.dot(b.cross(c));
  const Vec3 s = a + b + c;
  sums.zeroth += determinant / 6.0;
  sums.first += determinant / 24.0 * s;
  sums.second += determinant / 120.0 *
                 (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
}

}  // namespace

void MomentSums::add(double volume, const Vec3& centre, const Mat3& spread) {
  const Vec3 arm = centre - origin;
  zeroth += volume;
  first += volume * arm;
  second += spread + volume * arm * arm.transpose();
}

// I = tr(C) 1 - C for the central second moment C.
SolidMoments MomentSums::moments() const {
  if (zeroth == 0.0) return {};
  const Vec3 arm = first / zeroth;
  const Mat3 central = second - zeroth * arm * arm.transpose();
  return {zeroth, origin + arm, central.trace() * Mat3::Identity() - central};
}

SolidMoments solid_moments(const TriangleMesh& mesh) {
  MomentSums sums;
  const auto [low, high] = bounding_box(mesh);
  sums.origin = 0.5 * (low + high);
  for (const MeshTriangle& t : mesh.triangles)
    add_tetrahedron(sums, corners_from(mesh, t, sums.origin));
  return sums.moments();
}

double surface_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const MeshTriangle& t : mesh.triangles) {
    const auto [a, b, c] = corners_from(mesh, t, mesh.positions[t[0]]);
    area += 0.5 * b.cross(c).norm();
  }
  return area;
}

std::pair<Vec3, Vec3> bounding_box(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return {Vec3::Zero(), Vec3::Zero()};
  const Box3 box = bounds_of(mesh.positions);
  return {box.min(), box.max()};
}

}  // namespace limber
