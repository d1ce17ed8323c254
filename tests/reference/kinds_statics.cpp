// Group 3: lattices at rest, pulled, twisted or under their weight, through core/analysis; what is
// read off are sums and means over points.

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "core/analysis/equilibrium.h"
#include "core/analysis/vibration.h"
#include "tests/reference/build.h"
#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"
#include "tests/reference/readings.h"

namespace limber::reference {
namespace {

void pin(PhysicalModel& model, const std::vector<PointId>& points) {
  for (PointId p : points) model.points[p].pinned = true;
}

Vec3 mean_position(const PhysicalModel& model, const std::vector<PointId>& points) {
  Vec3 sum = Vec3::Zero();
  for (PointId p : points) sum += model.geometry.points[p];
  return sum / static_cast<double>(points.size());
}

// Displaces a point at the share s of the bar's length.
using Displacement = std::function<Vec3(const Vec3& at, double s)>;

// Bottom and top are held, what is between starts in proportion to its height.
PhysicalModel settled_between(const CubicLattice& shape, const Displacement& displaced) {
  PhysicalModel model = cubic_lattice(shape);
  const int top = shape.points[2] - 1;
  for (PointId p : ids_of(model.points)) {
    const double share = double(layer_of(shape, p, 2)) / top;
    model.geometry.points[p] = displaced(model.geometry.points[p], share);
  }
  pin(model, layer_points(shape, 2, 0));
  pin(model, layer_points(shape, 2, top));
  settle_or_throw(model, Vec3::Zero());
  return model;
}

// Where it is widest, along x.
double width_of(const std::vector<Vec3>& layer) {
  const auto [low, high] = std::minmax_element(
      layer.begin(), layer.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  return high->x() - low->x();
}

Json held_at_both_ends(const Case& c, const Displacement& displaced) {
  const CubicLattice shape = cubic_of(c.params);
  const PhysicalModel model = settled_between(shape, displaced);
  const std::vector<PointId> top = layer_points(shape, 2, shape.points[2] - 1);
  const auto support = support_forces(model, Vec3::Zero());
  const Vec3 centre = mean_position(model, top);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (PointId p : top) {
    force += support[p];
    torque += (model.geometry.points[p] - centre).cross(support[p]);
  }
  const int middle = c.inputs.value("mid_layer_index", shape.points[2] / 2);
  std::vector<Vec3> layer;
  for (PointId p : layer_points(shape, 2, middle)) layer.push_back(model.geometry.points[p]);
  return {{"elastic_energy", elastic_energy(compiled(model))},
          {"force_holding_top", to_json(force)},
          {"torque_z_holding_top", torque.z()},
          {"mid_layer_positions", to_json(layer)},
          {"mid_layer_width_x", width_of(layer)}};
}

Json pinned_stretch(const Case& c) {
  const double by = c.params.at("val");
  return held_at_both_ends(
      c, [&](const Vec3& x, double share) -> Vec3 { return x + share * by * Vec3::UnitZ(); });
}

Json pinned_shear(const Case& c) {
  const double by = c.params.at("val");
  return held_at_both_ends(
      c, [&](const Vec3& x, double share) -> Vec3 { return x + share * by * Vec3::UnitX(); });
}

Json pinned_torsion(const Case& c) {
  const double by = c.params.at("val");
  const CubicLattice shape = cubic_of(c.params);
  const Vec3 axis = 0.5 * shape.spacing * Vec3(shape.points[0] - 1, shape.points[1] - 1, 0.0);
  return held_at_both_ends(c, [&](const Vec3& x, double share) -> Vec3 {
    return axis + Eigen::AngleAxisd(share * by, Vec3::UnitZ()) * (x - axis);
  });
}

// A lattice held at its first layer along an axis that hangs or stands under its weight.
struct Loaded {
  PhysicalModel model;      // at rest
  std::vector<Vec3> moved;  // by layer: mean displacement, m
  std::vector<Vec3> moved_linear;
  Vec3 gravity;
};

std::vector<Vec3> mean_by_layer(const CubicLattice& shape, int axis,
                                const IdVector<PointId, Vec3>& displacement) {
  std::vector<Vec3> means;
  for (int layer = 0; layer < shape.points[axis]; ++layer) {
    const auto points = layer_points(shape, axis, layer);
    Vec3 sum = Vec3::Zero();
    for (PointId p : points) sum += displacement[p];
    means.push_back(sum / static_cast<double>(points.size()));
  }
  return means;
}

Loaded loaded(const Case& c, int axis) {
  const CubicLattice shape = cubic_of(c.params);
  Loaded result;
  result.gravity = gravity_of(c.params);
  PhysicalModel& model = result.model = cubic_lattice(shape);
  pin(model, layer_points(shape, axis, 0));
  const auto start = model.geometry.points;
  result.moved_linear = mean_by_layer(shape, axis, linear_sag(model, result.gravity));
  settle_or_throw(model, result.gravity);
  IdVector<PointId, Vec3> displacement = model.geometry.points;
  for (PointId p : ids_of(start)) displacement[p] -= start[p];
  result.moved = mean_by_layer(shape, axis, displacement);
  return result;
}

Json z_of(const std::vector<Vec3>& vectors) {
  Json z = Json::array();
  for (const Vec3& v : vectors) z.push_back(v.z());
  return z;
}

Json column_sag(const Case& c) {
  const CubicLattice shape = cubic_of(c.params);
  const Loaded column = loaded(c, 2);
  const PointId corner = point_of(shape, {0, 0, shape.points[2] - 1});
  const Vec3 corner_start = cubic_lattice(shape).geometry.points[corner];
  double mass = 0.0, support = 0.0;
  for (const PointAttributes& p : column.model.points) mass += p.mass;
  for (const Vec3& f : support_forces(column.model, column.gravity)) support += f.z();
  return {{"total_mass", mass},
          {"mean_dz_by_layer", z_of(column.moved)},
          {"top_mean_dz", column.moved.back().z()},
          {"top_corner_displacement",
           to_json(Vec3(column.model.geometry.points[corner] - corner_start))},
          {"top_mean_dz_linear", column.moved_linear.back().z()},
          {"bottom_layer_support_force_z", support},
          {"elastic_energy", elastic_energy(compiled(column.model))},
          {"lowest_omega", lowest_frequencies(column.model, 1).at(0)}};
}

Json cantilever(const Case& c) {
  const Loaded beam = loaded(c, 0);
  return {{"tip_mean_displacement", to_json(beam.moved.back())},
          {"tip_mean_dz_linear", beam.moved_linear.back().z()},
          {"centre_dz_by_section", z_of(beam.moved)},
          {"elastic_energy", elastic_energy(compiled(beam.model))},
          {"max_abs_elongation", largest_stretch(compiled(beam.model))},
          {"lowest_omega", lowest_frequencies(beam.model, 1).at(0)}};
}

}  // namespace

Kinds statics_kinds() {
  return {{"pinned_stretch", pinned_stretch},
          {"pinned_torsion", pinned_torsion},
          {"pinned_shear", pinned_shear},
          {"column_sag", column_sag},
          {"cantilever", cantilever}};
}

}  // namespace limber::reference
