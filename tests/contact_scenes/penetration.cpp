#include "tests/contact_scenes/penetration.h"

#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <algorithm>
#include <cmath>

#include "bullet_bridge/conversions.h"
#include "core/modeller/winding_number.h"
#include "core/operators/boundary_operator.h"
#include "tests/contact_scenes/true_shape.h"

namespace limber::bullet::test {
namespace {

constexpr double kProbeSpacing = 0.02;  // m, between samples

using Box = Eigen::AlignedBox3d;
using Triangle = std::array<Vec3, 3>;

// A flexible body as geometry.
struct Body {
  std::vector<Vec3> samples;
  std::vector<Triangle> triangles;
  bool solid = false;
  Box box;
};

void add_edges(Body& body, const PhysicalModel& model) {
  for (EdgeId e : ids_of(model.edges)) {
    if (model.edges[e].broken) continue;
    const Vec3 a = model.geometry.points[model.geometry.edges[e].a];
    const Vec3 b = model.geometry.points[model.geometry.edges[e].b];
    body.samples.push_back(a);
    body.samples.push_back(b);
    const int n = model.geometry.faces.empty() ? int(std::ceil((b - a).norm() / kProbeSpacing)) : 1;
    for (int i = 1; i < n; ++i) body.samples.push_back(a + (b - a) * (double(i) / n));
  }
}

void add_samples(Body& body, const Triangle& t) {
  const double longest =
      std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
  // What a blow-up stretched is seen as well by fewer.
  const int n = std::clamp(int(std::ceil(longest / kProbeSpacing)), 1, 20);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      body.samples.push_back(t[0] + (t[1] - t[0]) * (double(i) / n) +
                             (t[2] - t[0]) * (double(j) / n));
    }
  }
}

// The vector area of a closed surface vanishes, whatever its shape; that of a sheet does not.
bool is_closed(const std::vector<Triangle>& triangles) {
  Vec3 area = Vec3::Zero();
  double sum = 0.0;
  for (const Triangle& t : triangles) {
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    area += normal;
    sum += normal.norm();
  }
  return area.norm() < 1e-9 * sum;
}

Body body_of(const PhysicalModel& model) {
  Body body;
  add_edges(body, model);
  const SurfaceModel surface = boundary(model);
  for (const SurfaceTriangle& triangle : surface.triangles) {
    const auto& c = triangle.corners;
    body.triangles.push_back({surface.points[c[0]], surface.points[c[1]], surface.points[c[2]]});
    add_samples(body, body.triangles.back());
  }
  body.solid = is_closed(body.triangles);
  for (const Vec3& p : body.samples) body.box.extend(p);
  return body;
}

double distance(const Triangle& triangle, const Vec3& p) {
  btSubSimplexClosestResult closest;
  closest.m_usedVertices.reset();
  btVoronoiSimplexSolver().closestPtPointTriangle(
      btVector3(0, 0, 0), to_bullet(Vec3(triangle[0] - p)), to_bullet(Vec3(triangle[1] - p)),
      to_bullet(Vec3(triangle[2] - p)), closest);
  return from_bullet(closest.m_closestPointOnSimplex).norm();
}

double depth_in_body(const Body& body, const Vec3& p) {
  if (!body.solid || !body.box.contains(p)) return 0.0;
  double solid_angles = 0.0;
  for (const Triangle& t : body.triangles) solid_angles += solid_angle(t[0], t[1], t[2], p);
  if (std::abs(solid_angles) < 2.0 * M_PI) return 0.0;  // half of the full 4 pi
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : body.triangles) nearest = std::min(nearest, distance(t, p));
  return nearest;
}

double penetration(const Body& a, const Body& b) {
  if (!a.box.intersects(b.box)) return 0.0;
  double depth = 0.0;
  for (const Vec3& p : a.samples) depth = std::max(depth, depth_in_body(b, p));
  for (const Vec3& p : b.samples) depth = std::max(depth, depth_in_body(a, p));
  return depth;
}

Box bounds(const btRigidBody& rigid) {
  btVector3 low, high;
  rigid.getAabb(low, high);
  return {from_bullet(low), from_bullet(high)};
}

double penetration(const Body& body, const btRigidBody& rigid) {
  const Box overlap = bounds(rigid).intersection(body.box);
  if (overlap.isEmpty()) return 0.0;
  const btTransform& pose = rigid.getWorldTransform();
  const Eigen::Quaterniond rotation = from_bullet(pose.getRotation());
  const Vec3 origin = from_bullet(pose.getOrigin());
  const btCollisionShape& shape = *rigid.getCollisionShape();
  double depth = 0.0;
  for (const Vec3& p : body.samples) {
    if (!overlap.contains(p)) continue;
    depth = std::max(depth, test::depth_inside(shape, rotation.conjugate() * (p - origin)));
  }
  // What is metres large does not disappear in a lattice: the lattice's samples see it.
  if (bounds(rigid).sizes().maxCoeff() > 2.0) return depth;
  for (const Vec3& p : probes_of(shape, kProbeSpacing)) {
    depth = std::max(depth, depth_in_body(body, rotation * p + origin));
  }
  return depth;
}

}  // namespace

double deepest_penetration(const SceneState& state) {
  std::vector<Body> bodies;
  for (const PhysicalModel& model : state.flexible) bodies.push_back(body_of(model));
  double depth = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) depth = std::max(depth, penetration(bodies[i], bodies[j]));
    for (const btRigidBody* rigid : state.rigid) {
      depth = std::max(depth, penetration(bodies[i], *rigid));
    }
  }
  return depth;
}

}  // namespace limber::bullet::test
