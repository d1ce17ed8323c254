#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/model/vec3.h"

class btCollisionShape;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A part of a piece that the fit keeps together: a cell, or a point without one.
struct ShapeItem {
  std::vector<Vec3> points;  // in the body's frame, m
  double volume = 0.0;       // m^3
};

// A collision shape and what it is made of.
class ProxyShape {
 public:
  ProxyShape();
  ~ProxyShape();
  ProxyShape(ProxyShape&&) noexcept;
  ProxyShape& operator=(ProxyShape&&) noexcept;

  btCollisionShape& shape() const { return *parts_.back(); }

 private:
  friend ProxyShape fit_proxy_shape(std::vector<ShapeItem> items);
  std::vector<std::unique_ptr<btCollisionShape>> parts_;  // the whole comes last
};

// Convex hulls around the items: one where the piece nearly fills it, otherwise up to eight, the
// items halved along their longest extent (a pot's wall is no lump of clay). Hulls are shrunk by
// Bullet's collision margin, so that no proxy floats on it.
ProxyShape fit_proxy_shape(std::vector<ShapeItem> items);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
