#include "demos/render/crease_normals.h"

#include <cmath>

namespace limber::demos {
namespace {

struct Corner {
  int triangle;
  double angle;  // rad
};

Vec3 corner_point(const SurfaceModel& s, const SurfaceTriangle& t, int c) {
  return s.points[static_cast<std::size_t>(t.corners[static_cast<std::size_t>(c % 3)])];
}

Vec3 face_normal(const SurfaceModel& s, const SurfaceTriangle& t) {
  const Vec3 a = corner_point(s, t, 0);
  return (corner_point(s, t, 1) - a).cross(corner_point(s, t, 2) - a).normalized();
}

double corner_angle(const SurfaceModel& s, const SurfaceTriangle& t, int c) {
  const Vec3 u = corner_point(s, t, c + 1) - corner_point(s, t, c);
  const Vec3 v = corner_point(s, t, c + 2) - corner_point(s, t, c);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

std::vector<std::vector<Corner>> corners_of_points(const SurfaceModel& s) {
  std::vector<std::vector<Corner>> around(s.points.size());
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const int point = s.triangles[t].corners[static_cast<std::size_t>(c)];
      around[static_cast<std::size_t>(point)].push_back(
          {static_cast<int>(t), corner_angle(s, s.triangles[t], c)});
    }
  }
  return around;
}

bool same_skin(const SurfaceTriangle& a, const SurfaceTriangle& b) {
  return a.subobject == b.subobject && a.exposed_by_breaking == b.exposed_by_breaking;
}

}  // namespace

std::vector<std::array<Vec3, 3>> crease_normals(const SurfaceModel& surface, double crease_rad) {
  const auto around = corners_of_points(surface);
  const double least_cosine = std::cos(crease_rad);
  std::vector<Vec3> flat;
  flat.reserve(surface.triangles.size());
  for (const SurfaceTriangle& t : surface.triangles) flat.push_back(face_normal(surface, t));

  const auto smooth = [&](std::size_t t, int point) {
    Vec3 sum = Vec3::Zero();
    for (const Corner& other : around[static_cast<std::size_t>(point)]) {
      const auto o = static_cast<std::size_t>(other.triangle);
      if (!same_skin(surface.triangles[t], surface.triangles[o])) continue;
      if (flat[t].dot(flat[o]) >= least_cosine) sum += other.angle * flat[o];
    }
    return sum.squaredNorm() > 0.0 ? Vec3(sum.normalized()) : flat[t];
  };
  std::vector<std::array<Vec3, 3>> normals(surface.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) {
    const auto& corners = surface.triangles[t].corners;
    for (std::size_t c = 0; c < 3; ++c) normals[t][c] = smooth(t, corners[c]);
  }
  return normals;
}

}  // namespace limber::demos
