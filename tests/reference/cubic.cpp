#include "tests/reference/cubic.h"

#include <cmath>

namespace limber::reference {

CubicLattice cubic_of(const Json& params) {
  CubicLattice shape;
  shape.points = params.value("points", shape.points);
  shape.spacing = params.at("a");
  shape.springs = {params.value("k1", 0.0), params.value("k2", 0.0), params.value("k3", 0.0)};
  shape.mass = params.value("m", 1.0);
  shape.damping_per_stiffness = params.value("beta", 0.0);
  const bool is_shared = params.value("variant", "uniform") == "shared";
  shape.surface = is_shared ? CubicSurface::kShared : CubicSurface::kUniform;
  return shape;
}

PhysicalModel cubic_model(const CubicLattice& shape) {
  PhysicalModel model = cubic_lattice(shape);
  model.object.contact_share = 0.0;
  return model;
}

PhysicalModel cubic_model(const Json& params) { return cubic_model(cubic_of(params)); }

PointId point_of(const CubicLattice& shape, const std::array<int, 3>& at) {
  const auto& [nx, ny, nz] = shape.points;
  return PointId(static_cast<std::size_t>(at[0] + nx * (at[1] + ny * at[2])));
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

std::string family_of(double rest_length, double spacing) {
  const long squares = std::lround(std::pow(rest_length / spacing, 2));
  return squares == 1 ? "axial" : squares == 2 ? "face" : "body";
}

// From what surrounds the middle point of a block of 3 x 3 x 3 points.
Bulk bulk_of(CubicLattice shape) {
  shape.points = {3, 3, 3};
  shape.surface = CubicSurface::kUniform;
  const double cell = std::pow(shape.spacing, 3);
  Bulk bulk;
  bulk.lattice = lattice_around(cubic_lattice(shape), point_of(shape, {1, 1, 1}), cell);
  bulk.stiffness = elasticity(bulk.lattice);
  bulk.density = shape.mass / cell;
  return bulk;
}

double wave_speed(double modulus, double density) { return std::sqrt(modulus / density); }

}  // namespace limber::reference
