#include "tests/reference/grid.h"

namespace limber::reference {

CubicLattice cubic_of(const Json& params) {
  CubicLattice shape;
  shape.points = params.at("points").get<std::array<int, 3>>();
  shape.spacing = params.at("a");
  shape.springs = {params.value("k1", 0.0), params.value("k2", 0.0), params.value("k3", 0.0)};
  shape.mass = params.value("m", 1.0);
  const bool is_shared = params.value("variant", "uniform") == "shared";
  shape.surface = is_shared ? CubicSurface::kShared : CubicSurface::kUniform;
  return shape;
}

PointId point_of(const CubicLattice& shape, int ix, int iy, int iz) {
  return PointId(static_cast<std::size_t>(ix + shape.points[0] * (iy + shape.points[1] * iz)));
}

int layer_of(const CubicLattice& shape, PointId point, int axis) {
  int index = point.value;
  for (int i = 0; i < axis; ++i) index /= shape.points[i];
  return index % shape.points[axis];
}

std::vector<PointId> layer_points(const CubicLattice& shape, int axis, int layer) {
  const int count = shape.points[0] * shape.points[1] * shape.points[2];
  std::vector<PointId> found;
  for (int i = 0; i < count; ++i) {
    const PointId p(static_cast<std::size_t>(i));
    if (layer_of(shape, p, axis) == layer) found.push_back(p);
  }
  return found;
}

Mat3 mat3(const Json& rows) {
  Mat3 m;
  for (int row = 0; row < 3; ++row) m.row(row) = vec3(rows.at(row)).transpose();
  return m;
}

Json to_json(const std::vector<Vec3>& vectors) {
  Json values = Json::array();
  for (const Vec3& v : vectors) values.push_back(to_json(v));
  return values;
}

}  // namespace limber::reference
