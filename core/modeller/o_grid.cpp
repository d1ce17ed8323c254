#include "core/modeller/o_grid.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace limber {
namespace {

using GridIndex = std::array<int, 3>;  // of a point of the middle

class OGridPoints {
 public:
  OGridPoints(GeometricModelBuilder& builder, const OGrid& grid,
              const std::function<Vec3(const OGridPlace&)>& position)
      : grid_(grid), size_{grid.across, grid.along, grid.across} {
    for (int layer = 0; layer <= grid.layers; ++layer) add_layer(builder, layer, position);
  }

  PointId at(const GridIndex& i, int layer) const { return ids_[flat(i, layer)]; }

 private:
  void add_layer(GeometricModelBuilder& builder, int layer,
                 const std::function<Vec3(const OGridPlace&)>& position) {
    GridIndex i;
    for (i[2] = 0; i[2] <= size_[2]; ++i[2]) {
      for (i[1] = 0; i[1] <= size_[1]; ++i[1]) {
        for (i[0] = 0; i[0] <= size_[0]; ++i[0]) {
          const bool wanted = layer == 0 || has_layers(i);
          ids_.push_back(wanted ? builder.add_point(position(place(i, layer))) : PointId());
        }
      }
    }
  }

  bool has_layers(const GridIndex& i) const {
    return i[0] == 0 || i[0] == size_[0] || i[2] == 0 || i[2] == size_[2] ||
           (i[1] == 0 && grid_.low_cap) || (i[1] == size_[1] && grid_.high_cap);
  }

  OGridPlace place(const GridIndex& i, int layer) const {
    Vec3 middle;
    for (int axis = 0; axis < 3; ++axis) middle[axis] = 2.0 * i[axis] / size_[axis] - 1.0;
    return {middle, double(layer) / grid_.layers};
  }

  std::size_t flat(const GridIndex& i, int layer) const {
    std::size_t index = std::size_t(layer);
    for (int axis = 2; axis >= 0; --axis) {
      index = index * std::size_t(size_[axis] + 1) + std::size_t(i[axis]);
    }
    return index;
  }

  OGrid grid_;
  GridIndex size_;
  std::vector<PointId> ids_;  // by layer, then x fastest; nothing where there is no point
};

void add_middle(GeometricModelBuilder& builder, const OGrid& grid, const OGridPoints& points,
                const std::vector<std::array<int, 2>>& pairs) {
  for (int z = 0; z < grid.across; ++z) {
    for (int y = 0; y < grid.along; ++y) {
      for (int x = 0; x < grid.across; ++x) {
        HexahedronCorners corners;
        for (int c = 0; c < kHexahedronCorners; ++c) {
          corners[c] = points.at({x + (c & 1), y + (c >> 1 & 1), z + (c >> 2 & 1)}, 0);
        }
        add_hexahedron(builder, corners, pairs);
      }
    }
  }
}

// One side of the middle: across `axis`, at its high or low end.
struct Side {
  int axis;
  bool high;
};

// The cell on the square of the side that begins at `i`, between two layers.
void add_layer_cell(GeometricModelBuilder& builder, const OGridPoints& points, const Side& side,
                    const GridIndex& i, int layer, const std::vector<std::array<int, 2>>& pairs) {
  HexahedronCorners corners;
  for (int c = 0; c < kHexahedronCorners; ++c) {
    GridIndex at = i;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != side.axis) at[axis] += c >> axis & 1;
    }
    const bool outer = ((c >> side.axis & 1) == 1) == side.high;
    corners[c] = points.at(at, outer ? layer + 1 : layer);
  }
  add_hexahedron(builder, corners, pairs);
}

void add_side(GeometricModelBuilder& builder, const OGrid& grid, const OGridPoints& points,
              const Side& side, const std::vector<std::array<int, 2>>& pairs) {
  const GridIndex size = {grid.across, grid.along, grid.across};
  const int u = (side.axis + 1) % 3, v = (side.axis + 2) % 3;
  for (int layer = 0; layer < grid.layers; ++layer) {
    GridIndex i;
    i[side.axis] = side.high ? size[side.axis] : 0;
    for (i[v] = 0; i[v] < size[v]; ++i[v]) {
      for (i[u] = 0; i[u] < size[u]; ++i[u]) {
        add_layer_cell(builder, points, side, i, layer, pairs);
      }
    }
  }
}

// The middle's half width in the standard forms, and how far it is drawn from the cube (0) to the
// sphere through the middles of the cube's edges (1): at its edges and corners three cells meet at
// about 120 degrees.
constexpr double kHalfWidth = 0.4;
constexpr double kBulge = 0.5;

// The direction in which a place leaves the middle: equal steps of the grid are about equal angles.
Vec3 equiangular(const Vec3& on_cube) {
  return Vec3((on_cube * (std::numbers::pi / 4.0)).array().tan()).normalized();
}

Vec3 outward_from(const Vec3& middle, double outward, double edge_distance) {
  const double t = middle.cwiseAbs().maxCoeff();
  if (t == 0.0) return middle;
  const Vec3 direction = equiangular(middle / t);
  const Vec3 bulged = t * edge_distance * direction;
  const Vec3 inner = kHalfWidth * (middle + kBulge * t * (bulged - middle));
  return inner + outward * (direction - inner);
}

}  // namespace

double point_count(const OGrid& grid) {
  const double n = grid.across + 1.0, m = grid.along + 1.0;
  const double caps = (grid.low_cap ? 1.0 : 0.0) + (grid.high_cap ? 1.0 : 0.0);
  return n * n * m + grid.layers * (4.0 * grid.across * m + caps * n * n);
}

void add_o_grid(GeometricModelBuilder& builder, const OGrid& grid,
                const std::function<Vec3(const OGridPlace&)>& position, const CellEdges& edges) {
  const OGridPoints points(builder, grid, position);
  const auto pairs = corner_pairs(edges);
  add_middle(builder, grid, points, pairs);
  for (int axis : {0, 2}) {
    for (bool high : {false, true}) add_side(builder, grid, points, {axis, high}, pairs);
  }
  if (grid.low_cap) add_side(builder, grid, points, {1, false}, pairs);
  if (grid.high_cap) add_side(builder, grid, points, {1, true}, pairs);
}

Vec3 in_ball(const OGridPlace& place) {
  return outward_from(place.middle, place.outward, std::numbers::sqrt2);
}

Vec3 in_cylinder(const OGridPlace& place) {
  const Vec3 flat(place.middle.x(), 0.0, place.middle.z());
  Vec3 position = outward_from(flat, place.outward, std::numbers::sqrt2);
  position.y() = place.middle.y();
  return position;
}

}  // namespace limber
