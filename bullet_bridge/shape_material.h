#pragma once

#include <span>

#include "bullet_bridge/proxy_shape.h"
#include "core/dynamics/lattice.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// The cells of a piece that are whole; of one without, its points. `points`: of the lattice,
// ascending; `local`: where they are in the body's frame, m, like them. Both, and the lattice, have
// to outlive what is returned.
ShapeMaterial shape_material(const Lattice& lattice, std::span<const std::int32_t> points,
                             std::span<const Vec3> local);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
