#include "tests/support/blocks.h"

#include <gtest/gtest.h>

#include <bit>

namespace limber::test {
namespace {

// Corner i of a cell lies at (i & 1, i >> 1 & 1, i >> 2 & 1); squares run anticlockwise from
// outside and begin with their lowest corner.
constexpr int kSquares[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

using Corners = std::array<PointId, 8>;
using Pairs = std::vector<std::array<PointId, 2>>;

Pairs cell_edges(const Corners& c, const EdgeSet& set) {
  Pairs edges;
  for (unsigned i = 0; i < 8; ++i)
    for (unsigned j = i + 1; j < 8; ++j) {
      const int differing = std::popcount(i ^ j);
      if (differing == 1 || (differing == 2 && set.both_diagonals) ||
          (differing == 3 && set.body_diagonals))
        edges.push_back({c[i], c[j]});
    }
  if (set.one_diagonal)
    for (const auto& s : kSquares) edges.push_back({c[s[0]], c[s[2]]});
  return edges;
}

std::vector<std::array<PointId, 3>> cell_faces(const Corners& c) {
  std::vector<std::array<PointId, 3>> faces;
  for (const auto& s : kSquares)
    for (const auto& triangle : split_square({c[s[0]], c[s[1]], c[s[2]], c[s[3]]}))
      faces.push_back(triangle);
  return faces;
}

Corners corners_of_cell(const BlockShape& shape, int x, int y, int z) {
  Corners c;
  for (int i = 0; i < 8; ++i)
    c[i] = block_point(shape, {x + (i & 1), y + (i >> 1 & 1), z + (i >> 2 & 1)});
  return c;
}

}  // namespace

PointId block_point(const BlockShape& shape, std::array<int, 3> at) {
  const int nx = shape.cells[0] + 1, ny = shape.cells[1] + 1;
  return PointId(static_cast<std::size_t>(at[0] + nx * (at[1] + ny * at[2])));
}

GeometricModel block_geometry(const BlockShape& shape) {
  const auto& [kx, ky, kz] = shape.cells;
  GeometricModelBuilder builder;
  builder.begin_subobject(shape.name);
  for (int z = 0; z <= kz; ++z)
    for (int y = 0; y <= ky; ++y)
      for (int x = 0; x <= kx; ++x) builder.add_point(shape.origin + shape.spacing * Vec3(x, y, z));
  for (int z = 0; z < kz; ++z)
    for (int y = 0; y < ky; ++y)
      for (int x = 0; x < kx; ++x) {
        const Corners c = corners_of_cell(shape, x, y, z);
        builder.add_cell(cell_edges(c, shape.edges), cell_faces(c));
      }
  return builder.finish();
}

PhysicalModel with_plausible_attributes(GeometricModel geometry, std::string name) {
  PhysicalModel model = with_default_attributes(std::move(geometry), std::move(name));
  for (PointAttributes& point : model.points) point.mass = 1.0;
  for (EdgeAttributes& edge : model.edges) {
    edge.stiffness = 100.0;
    edge.damping = 1.0;
    edge.break_threshold = 0.1;
  }
  return model;
}

PhysicalModel block(const BlockShape& shape) {
  return with_plausible_attributes(block_geometry(shape), shape.name);
}

PhysicalModel uneven_block(std::array<int, 3> cells) {
  PhysicalModel model = block({.cells = cells});
  int i = 0;
  for (PointAttributes& p : model.points) p.mass = 0.5 + (i++ * 7 % 11) / 5.0;
  for (EdgeAttributes& e : model.edges) e.stiffness = 10.0 + (i++ * 5 % 13) * 30.0;
  return model;
}

EdgeId block_edge(const PhysicalModel& model, const BlockShape& shape, std::array<int, 3> from,
                  std::array<int, 3> to) {
  const PointId p = block_point(shape, from), q = block_point(shape, to);
  for (EdgeId e : ids_of(model.geometry.edges)) {
    const auto& [a, b] = model.geometry.edges[e];
    if ((a == p && b == q) || (a == q && b == p)) return e;
  }
  ADD_FAILURE() << "no edge between points " << p.value << " and " << q.value;
  return EdgeId(0);
}

PhysicalModel sheet(int n, bool polygons) {
  GeometricModelBuilder builder;
  builder.begin_subobject("sheet");
  const auto point = [&](int x, int y) { return PointId(std::size_t(x + (n + 1) * y)); };
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) builder.add_point(Vec3(x, y, 0));
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const PointId a = point(x, y), b = point(x + 1, y), c = point(x + 1, y + 1),
                    d = point(x, y + 1);
      const Pairs edges = {{a, b}, {b, c}, {c, d}, {d, a}, {a, c}};
      const auto faces = split_square({a, b, c, d});
      if (polygons) {
        builder.add_cell(edges, faces);
        continue;
      }
      for (const auto& [p, q] : edges) builder.edge(p, q);
      for (const auto& corners : faces) builder.add_face(corners);
    }
  return with_plausible_attributes(builder.finish(), "sheet");
}

}  // namespace limber::test
