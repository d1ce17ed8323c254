#include "core/modeller/box_lattice.h"

#include <bit>
#include <cmath>

#include "core/model/errors.h"

namespace limber {
namespace {

// A corner of the unit cell is a number of three bits: 1 is +x, 2 is +y, 4 is +z.
constexpr int kCorners = 8;

// The six sides, anticlockwise from outside.
constexpr std::array<std::array<int, 4>, 6> kSquares = {{
    {0, 4, 6, 2},  // -x
    {1, 3, 7, 5},  // +x
    {0, 1, 5, 4},  // -y
    {2, 6, 7, 3},  // +y
    {0, 2, 3, 1},  // -z
    {4, 5, 7, 6},  // +z
}};

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

// Corners that differ in one bit lie along an axis, in two across a square, in three through the
// body.
std::vector<std::array<int, 2>> corner_pairs(const CellEdges& edges) {
  std::vector<std::array<int, 2>> pairs;
  for (int a = 0; a < kCorners; ++a) {
    for (int b = a + 1; b < kCorners; ++b) {
      const int differing = std::popcount(static_cast<unsigned>(a ^ b));
      const bool is_from_lowest = (a & b) == a;
      const bool across = edges.face_diagonals || (edges.one_face_diagonal && is_from_lowest);
      const bool wanted = (differing == 1 && edges.axial) || (differing == 2 && across) ||
                          (differing == 3 && edges.body_diagonals);
      if (wanted) pairs.push_back({a, b});
    }
  }
  return pairs;
}

void add_hexahedron(GeometricModelBuilder& builder, const std::array<PointId, kCorners>& corners,
                    const std::vector<std::array<int, 2>>& pairs) {
  std::vector<std::array<PointId, 2>> edges;
  for (const auto& [a, b] : pairs) edges.push_back({corners[a], corners[b]});
  std::vector<std::array<PointId, 3>> faces;
  for (const auto& s : kSquares) {
    for (const auto& triangle :
         split_square({corners[s[0]], corners[s[1]], corners[s[2]], corners[s[3]]})) {
      faces.push_back(triangle);
    }
  }
  builder.add_cell(edges, faces);
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
        std::array<PointId, kCorners> corners;
        for (int c = 0; c < kCorners; ++c) {
          corners[c] = point(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2 & 1));
        }
        add_hexahedron(builder, corners, pairs);
      }
    }
  }
  return builder.finish();
}

}  // namespace limber
