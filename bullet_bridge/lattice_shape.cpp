#include "bullet_bridge/lattice_shape.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// No shape of Bullet's own has it, and Bullet takes it for a concave shape like any other.
// CUSTOM_CONCAVE_SHAPE_TYPE will not do: it has the number of distance fields, as which Bullet
// casts it (btConvexConcaveCollisionAlgorithm.cpp:229 in 3.24).
constexpr int kShapeType = FAST_CONCAVE_MESH_PROXYTYPE;

constexpr std::size_t kBlock = 32;  // triangles that share a box

}  // namespace

LatticeShape::LatticeShape(const Lattice& lattice, const BoundaryTracker& boundary,
                           std::span<const std::int32_t> points)
    : lattice_(lattice),
      boundary_(boundary),
      points_(points.begin(), points.end()),
      low_(0, 0, 0),
      high_(0, 0, 0),
      unscaled_(1, 1, 1) {
  m_shapeType = kShapeType;
}

btVector3 LatticeShape::local(const Vec3& place) const {
  return to_bullet(Vec3(to_local_ * (place - centre_)));
}

void LatticeShape::follow(const Vec3& centre, const Mat3& rotation) {
  centre_ = centre;
  to_local_ = rotation.transpose();
  gathered_ = false;
  low_ = high_ = local(lattice_.motion[points_[0]].position);
  for (std::int32_t p : points_) {
    const btVector3 place = local(lattice_.motion[p].position);
    low_.setMin(place);
    high_.setMax(place);
  }
}

void LatticeShape::list_faces() const {
  faces_.clear();
  const std::int32_t first = points_.front(), last = points_.back();
  for (std::int32_t f : boundary_.faces()) {
    const std::int32_t corner = lattice_.face_corners[f][0];
    if (corner < first || corner > last) continue;
    if (std::binary_search(points_.begin(), points_.end(), corner)) faces_.push_back(f);
  }
  std::sort(faces_.begin(), faces_.end());
  revision_ = boundary_.revision();
  listed_ = true;
}

void LatticeShape::gather() const {
  if (!listed_ || revision_ != boundary_.revision()) {
    list_faces();
  } else if (gathered_) {
    return;
  }
  triangles_.clear();
  blocks_.clear();
  for (std::int32_t f : faces_) {
    const auto& [a, b, c] = lattice_.face_corners[f];
    triangles_.push_back({local(lattice_.motion[a].position), local(lattice_.motion[b].position),
                          local(lattice_.motion[c].position)});
  }
  for (std::size_t begin = 0; begin < triangles_.size(); begin += kBlock) {
    Block block{triangles_[begin][0], triangles_[begin][0], begin,
                std::min(begin + kBlock, triangles_.size())};
    for (std::size_t i = block.begin; i < block.end; ++i) {
      for (const btVector3& corner : triangles_[i]) {
        block.low.setMin(corner);
        block.high.setMax(corner);
      }
    }
    blocks_.push_back(block);
  }
  gathered_ = true;
}

void LatticeShape::processAllTriangles(btTriangleCallback* callback, const btVector3& low,
                                       const btVector3& high) const {
  gather();
  const std::int32_t first_face =
      lattice_.objects[lattice_.point_object[points_.front()]].faces.begin;
  for (const Block& block : blocks_) {
    if (!TestAabbAgainstAabb2(low, high, block.low, block.high)) continue;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      if (!TestTriangleAgainstAabb2(triangles_[i].data(), low, high)) continue;
      callback->processTriangle(triangles_[i].data(), 0, faces_[i] - first_face);
    }
  }
}

void LatticeShape::getAabb(const btTransform& pose, btVector3& low, btVector3& high) const {
  btTransformAabb(low_, high_, getMargin(), pose, low, high);
  if (!becomes_static_) return;
  becomes_static_->setCollisionFlags(becomes_static_->getCollisionFlags() |
                                     btCollisionObject::CF_STATIC_OBJECT);
}

// Of the box around it. Nobody needs it: the body's moments come from the points.
void LatticeShape::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  const btVector3 size = high_ - low_;
  const btVector3 squares = size * size;
  const btScalar sum = squares.x() + squares.y() + squares.z();
  inertia = (btVector3(sum, sum, sum) - squares) * (mass / btScalar(12));
}

bool stands_for_lattice(const btCollisionObject& object) {
  const btCollisionShape* shape = object.getCollisionShape();
  return shape && shape->getShapeType() == kShapeType;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
