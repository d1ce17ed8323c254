#include "bullet_bridge/stage_body.h"

#include <btBulletDynamicsCommon.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/shapes/convex_planes.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

using ShapePointer = std::unique_ptr<btCollisionShape>;

// Hulls are laid in by this share of their size, and stand out by as much (Bullet's margin).
constexpr double kHullMargin = 0.01;
constexpr double kRoundMargin = 0.01;  // cones likewise, of their smaller side

btScalar scalar(double value) { return static_cast<btScalar>(value); }

ShapePointer hull_of(const HullShape& hull) {
  Vec3 low = hull.points.front(), high = low, middle = Vec3::Zero();
  for (const Vec3& p : hull.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    middle += p / static_cast<double>(hull.points.size());
  }
  const double margin = kHullMargin * (high - low).minCoeff();
  auto shape = std::make_unique<btConvexHullShape>();
  shape->setMargin(scalar(margin));
  for (const Vec3& p : hull.points) {
    const Vec3 outwards = p - middle;
    const double reach = std::max(outwards.norm(), margin);
    shape->addPoint(to_bullet(Vec3(p - margin / reach * outwards)), false);
  }
  shape->recalcLocalAabb();
  return shape;
}

TriangleList triangles_of_hull(const HullShape& hull) {
  TriangleList list{hull.points, {}};
  for (const HullFace& face : hull_faces(hull.points)) {
    for (std::size_t i = 1; i + 1 < face.corners.size(); ++i) {
      list.triangles.push_back({face.corners[0], face.corners[i], face.corners[i + 1]});
    }
  }
  return list;
}

TriangleList triangles_of_terrain(const TerrainShape& terrain) {
  TriangleList list;
  const Vec3 corner(-0.5 * terrain.spacing * (terrain.columns - 1), 0.0,
                    -0.5 * terrain.spacing * (terrain.rows - 1));
  for (int r = 0; r < terrain.rows; ++r) {
    for (int c = 0; c < terrain.columns; ++c) {
      const double height = terrain.heights[static_cast<std::size_t>(r * terrain.columns + c)];
      list.positions.push_back(corner + Vec3(c * terrain.spacing, height, r * terrain.spacing));
      if (r == 0 || c == 0) continue;
      const int here = r * terrain.columns + c, above = here - terrain.columns;
      list.triangles.push_back({above - 1, here - 1, here});
      list.triangles.push_back({above - 1, here, above});
    }
  }
  return list;
}

}  // namespace

struct OwnedShape::Data {
  btTriangleMesh mesh;
  Mat3 axes = Mat3::Identity();
  std::vector<ShapePointer> parts;  // of a compound

  ShapePointer of_triangles(const TriangleList& list) {
    for (const auto& t : list.triangles) {
      mesh.addTriangle(to_bullet(list.positions[static_cast<std::size_t>(t[0])]),
                       to_bullet(list.positions[static_cast<std::size_t>(t[1])]),
                       to_bullet(list.positions[static_cast<std::size_t>(t[2])]));
    }
    return std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
  }

  ShapePointer operator()(const BoxShape& box) {
    return std::make_unique<btBoxShape>(to_bullet(box.half_extents));
  }
  ShapePointer operator()(const SphereShape& sphere) {
    return std::make_unique<btSphereShape>(scalar(sphere.radius));
  }
  ShapePointer operator()(const CapsuleShape& capsule) {
    return std::make_unique<btCapsuleShape>(scalar(capsule.radius), scalar(capsule.height));
  }
  ShapePointer operator()(const CylinderShape& cylinder) {
    const btVector3 half(scalar(cylinder.radius), scalar(0.5 * cylinder.height),
                         scalar(cylinder.radius));
    return std::make_unique<btCylinderShape>(half);
  }
  // Bullet lays its margin around a cone: it stands on that.
  ShapePointer operator()(const ConeShape& cone) {
    const double margin = kRoundMargin * std::min(cone.radius, cone.height);
    auto shape = std::make_unique<btConeShape>(scalar(cone.radius - margin),
                                               scalar(cone.height - 2.0 * margin));
    shape->setMargin(scalar(margin));
    return shape;
  }
  ShapePointer operator()(const HullShape& hull) { return hull_of(hull); }
  ShapePointer operator()(const MeshShape& shape) {
    return of_triangles({shape.positions, shape.triangles});
  }
  // As a mesh: Bullet's own height field keeps a reference to heights that it moves to their
  // middle.
  ShapePointer operator()(const TerrainShape& terrain) {
    return of_triangles(triangles_of_terrain(terrain));
  }
  ShapePointer operator()(const CompoundShape& compound) {
    auto whole = std::make_unique<btCompoundShape>();
    for (const CompoundShape::Part& part : compound.parts) {
      parts.push_back(std::visit(*this, part.shape));
      const Mat3 rotation = axes.transpose() * part.rotation;
      whole->addChildShape(btTransform(to_bullet(Eigen::Quaterniond(rotation)),
                                       to_bullet(Vec3(axes.transpose() * part.centre))),
                           parts.back().get());
    }
    return whole;
  }
};

OwnedShape::OwnedShape(const StageShape& shape, const Mat3& axes)
    : data_(std::make_unique<Data>()) {
  data_->axes = axes;
  shape_ = std::visit(*data_, shape);
}
OwnedShape::~OwnedShape() = default;
OwnedShape::OwnedShape(OwnedShape&&) noexcept = default;

namespace {

// Tetrahedra from the origin to the triangles.
SolidVolume volume_within(const TriangleList& list) {
  SolidVolume sum;
  for (const auto& t : list.triangles) {
    const Vec3& a = list.positions[static_cast<std::size_t>(t[0])];
    const Vec3& b = list.positions[static_cast<std::size_t>(t[1])];
    const Vec3& c = list.positions[static_cast<std::size_t>(t[2])];
    const double volume = a.dot(b.cross(c)) / 6.0;
    sum.volume += volume;
    sum.centre += volume * (a + b + c) / 4.0;
  }
  sum.centre /= sum.volume;
  return sum;
}

struct VolumeOf {
  using V = SolidVolume;
  static double disc(double radius) { return std::numbers::pi * radius * radius; }

  V operator()(const BoxShape& b) const { return {8.0 * b.half_extents.prod()}; }
  V operator()(const SphereShape& s) const { return {4.0 / 3.0 * s.radius * disc(s.radius)}; }
  V operator()(const CapsuleShape& c) const {
    return {disc(c.radius) * (c.height + 4.0 / 3.0 * c.radius)};
  }
  V operator()(const CylinderShape& c) const { return {disc(c.radius) * c.height}; }
  // A quarter of its height above its base.
  V operator()(const ConeShape& c) const {
    return {disc(c.radius) * c.height / 3.0, Vec3(0.0, -0.25 * c.height, 0.0)};
  }
  V operator()(const HullShape& hull) const { return volume_within(triangles_of_hull(hull)); }
};

Vec3 centre_of(const CompoundShape::Part& part) {
  return part.centre + part.rotation * volume_of(part.shape).centre;
}

// kg m^2, about the part's own centre of mass, in its frame: what Bullet takes for a body of that
// shape alone.
Vec3 own_moments(const SolidShape& shape, double mass) {
  const OwnedShape made(std::visit([](const auto& s) { return StageShape(s); }, shape));
  btVector3 moments;
  made.shape().calculateLocalInertia(static_cast<btScalar>(mass), moments);
  return from_bullet(moments);
}

}  // namespace

SolidVolume volume_of(const SolidShape& shape) { return std::visit(VolumeOf{}, shape); }

SolidVolume volume_of(const CompoundShape& compound) {
  SolidVolume sum;
  for (const CompoundShape::Part& part : compound.parts) {
    const double volume = volume_of(part.shape).volume;
    sum.volume += volume;
    sum.centre += volume * centre_of(part);
  }
  sum.centre /= sum.volume;
  return sum;
}

Vec3 centre_parts(CompoundShape& compound) {
  const Vec3 centre = volume_of(compound).centre;
  for (CompoundShape::Part& part : compound.parts) part.centre -= centre;
  return centre;
}

// Steiner: I = sum R I_own R^T + m (r^2 1 - r r^T).
PrincipalFrame principal_frame(const CompoundShape& compound, double mass) {
  const double density = mass / volume_of(compound).volume;
  Mat3 inertia = Mat3::Zero();
  for (const CompoundShape::Part& part : compound.parts) {
    const double share = density * volume_of(part.shape).volume;
    const Vec3 r = centre_of(part);
    inertia +=
        part.rotation * own_moments(part.shape, share).asDiagonal() * part.rotation.transpose();
    inertia += share * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  PrincipalFrame frame{solver.eigenvectors(), solver.eigenvalues()};
  if (frame.axes.determinant() < 0.0) frame.axes.col(0) *= -1.0;
  return frame;
}

TriangleList triangles_of(const StageShape& shape) {
  if (const auto* hull = std::get_if<HullShape>(&shape)) return triangles_of_hull(*hull);
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) return {mesh->positions, mesh->triangles};
  if (const auto* terrain = std::get_if<TerrainShape>(&shape))
    return triangles_of_terrain(*terrain);
  return {};
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
