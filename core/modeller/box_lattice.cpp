#include "core/modeller/box_lattice.h"

#include <cmath>

#include "core/model/errors.h"

namespace limber {
namespace {

void require_box(std::array<int, 3> cells, const Vec3& spacing_m, const std::string& name) {
  for (int axis = 0; axis < 3; ++axis) {
    if (cells[axis] < 1) {
      throw InputError(
          {name, "axis " + std::to_string(axis) + " has " + std::to_string(cells[axis]) + " cells",
           "give at least one cell along every axis"});
    }
    if (!(spacing_m[axis] > 0.0) || !std::isfinite(spacing_m[axis])) {
      throw InputError({name,
                        "spacing along axis " + std::to_string(axis) + " is " +
                            std::to_string(spacing_m[axis]) + " m",
                        "give a positive spacing"});
    }
  }
}

void add_points(GeometricModelBuilder& builder, std::array<int, 3> cells, const Vec3& spacing_m,
                const Vec3& origin_m) {
  for (int z = 0; z <= cells[2]; ++z) {
    for (int y = 0; y <= cells[1]; ++y) {
      for (int x = 0; x <= cells[0]; ++x) {
        builder.add_point(origin_m + Vec3(x, y, z).cwiseProduct(spacing_m));
      }
    }
  }
}

}  // namespace

GeometricModel box_lattice(std::array<int, 3> cells, const Vec3& spacing_m, const Vec3& origin_m,
                           const std::string& name, CellEdges edges) {
  require_box(cells, spacing_m, name);
  GeometricModelBuilder builder;
  builder.begin_subobject(name);
  add_points(builder, cells, spacing_m, origin_m);

  const auto point = [&](int x, int y, int z) {
    return PointId(std::size_t(x) +
                   std::size_t(cells[0] + 1) * (std::size_t(y) + std::size_t(cells[1] + 1) * z));
  };
  const auto pairs = corner_pairs(edges);
  for (int z = 0; z < cells[2]; ++z) {
    for (int y = 0; y < cells[1]; ++y) {
      for (int x = 0; x < cells[0]; ++x) {
        HexahedronCorners corners;
        for (int c = 0; c < kHexahedronCorners; ++c) {
          corners[c] = point(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2 & 1));
        }
        add_hexahedron(builder, corners, pairs);
      }
    }
  }
  return builder.finish();
}

}  // namespace limber
