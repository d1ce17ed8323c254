#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/model/index_rows.h"
#include "core/model/vec3.h"

class btCollisionShape;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// Parts of a piece that the fit keeps together: its cells.
struct ShapeParts {
  IndexRows points;             // part -> of the material's
  std::vector<double> volumes;  // shape (parts), m^3
};

// What a shape is fitted to, in the body's frame.
struct ShapeMaterial {
  std::vector<Vec3> points;  // m, of all parts
  double volume = 0.0;       // m^3, of all parts
  std::size_t parts = 0;     // how many there are
  // They cost more than the fit of most shapes and are asked for only where it needs several hulls.
  std::function<ShapeParts()> list_parts;
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
  friend ProxyShape fit_proxy_shape(const ShapeMaterial& material);
  std::vector<std::unique_ptr<btCollisionShape>> parts_;  // the whole comes last
};

// Convex hulls around the material: one where it nearly fills it, otherwise up to eight, the parts
// halved along their longest extent (a pot's wall is no lump of clay). Hulls are shrunk by Bullet's
// collision margin, so that no proxy floats on it. How far the shape is from the material:
// docs/accuracy.md.
ProxyShape fit_proxy_shape(const ShapeMaterial& material);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
