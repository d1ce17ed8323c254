#include "bullet_bridge/shapes/shape_cache.h"

#include <BulletCollision/CollisionShapes/btPolyhedralConvexShape.h>

#include <algorithm>
#include <vector>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/shapes/convex_planes.h"
#include "core/storage/state_hash.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

std::vector<Vec3> corners_of(const btPolyhedralConvexShape& shape) {
  std::vector<Vec3> corners;
  for (int i = 0; i < shape.getNumVertices(); ++i) {
    btVector3 corner;
    shape.getVertex(i, corner);
    corners.push_back(from_bullet(corner));
  }
  return corners;
}

std::uint64_t signature_of(const std::vector<Vec3>& corners, double margin) {
  StateHash hash;
  for (const Vec3& c : corners) hash.add(std::span(c.data(), 3));
  hash.add(margin);
  return hash.value();
}

std::shared_ptr<const ConvexPlanes> built(std::vector<Vec3> corners, double margin) {
  const std::vector<HullFace> faces = hull_faces(corners);
  if (faces.empty()) return nullptr;
  return std::make_shared<const ConvexPlanes>(std::move(corners), faces, margin);
}

}  // namespace

std::shared_ptr<const ConvexPlanes> ShapeCache::planes_of(const btPolyhedralConvexShape& shape) {
  return planes_around(corners_of(shape), shape.getMargin());
}

std::shared_ptr<const ConvexPlanes> ShapeCache::planes_around(std::vector<Vec3> corners,
                                                              double margin) {
  const std::uint64_t signature = signature_of(corners, margin);
  const auto known = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& e) { return e.signature == signature; });
  if (known != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, known);
  } else {
    entries_.push_front({signature, built(std::move(corners), margin)});
    if (entries_.size() > capacity_) entries_.pop_back();
  }
  return entries_.front().planes;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
