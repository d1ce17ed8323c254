#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

class btPolyhedralConvexShape;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

class ConvexPlanes;

// Planes of polyhedra, kept from tick to tick. Known by their corners, not by address: a freed
// shape's address comes again with other contents, and equal shapes share one entry. The one not
// asked for the longest goes when there are more than `capacity`.
class ShapeCache {
 public:
  explicit ShapeCache(std::size_t capacity = 256) : capacity_(capacity) {}

  // Null where the shape has no volume, or no corners that it tells.
  std::shared_ptr<const ConvexPlanes> planes_of(const btPolyhedralConvexShape& shape);
  // Around points, m, and within `margin` of them.
  std::shared_ptr<const ConvexPlanes> planes_around(std::vector<Vec3> corners, double margin);

  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::uint64_t signature;
    std::shared_ptr<const ConvexPlanes> planes;
  };
  std::size_t capacity_;
  std::list<Entry> entries_;  // the one asked for last comes first
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
