#include "tests/reference/build.h"

#include <array>
#include <string>

#include "core/modeller/cubic_lattice.h"

namespace limber::reference {

Vec3 vec3(const Json& numbers) {
  const auto xyz = numbers.get<std::array<double, 3>>();
  return {xyz[0], xyz[1], xyz[2]};
}

Json to_json(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json to_json(const Mat3& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) rows.push_back(to_json(Vec3(matrix.row(row))));
  return rows;
}

PhysicalModel network(const std::vector<MassPoint>& points, const std::vector<Bond>& bonds) {
  GeometricModelBuilder builder;
  builder.begin_subobject("network");
  for (const MassPoint& point : points) builder.add_point(point.position);
  for (const Bond& bond : bonds) {
    builder.edge(PointId(std::size_t(bond.a)), PointId(std::size_t(bond.b)));
  }
  PhysicalModel model = with_default_attributes(builder.finish(), "network");
  for (std::size_t p = 0; p < points.size(); ++p) {
    model.points[PointId(p)] = {points[p].mass, points[p].velocity, points[p].pinned};
  }
  for (std::size_t e = 0; e < bonds.size(); ++e) {
    EdgeAttributes& edge = model.edges[EdgeId(e)];
    edge.stiffness = bonds[e].stiffness;
    edge.damping = bonds[e].damping;
    edge.rest_length = bonds[e].rest_length;
  }
  model.object.contact_share = 0.0;
  return model;
}

std::vector<Bond> chain_bonds(std::size_t points, double stiffness, double rest_length,
                              double damping) {
  std::vector<Bond> bonds;
  for (int i = 1; i < static_cast<int>(points); ++i) {
    bonds.push_back({i - 1, i, stiffness, rest_length, damping});
  }
  return bonds;
}

PhysicalModel lattice_model(const Json& params) {
  CubicLattice lattice;
  lattice.points = params.at("points").get<std::array<int, 3>>();
  lattice.spacing = params.at("a");
  lattice.springs = {params.value("k1", 0.0), params.value("k2", 0.0), params.value("k3", 0.0)};
  lattice.mass = params.at("m");
  lattice.damping_per_stiffness = params.value("beta", 0.0);
  const bool shared = params.value("variant", "uniform") == "shared";
  lattice.surface = shared ? CubicSurface::kShared : CubicSurface::kUniform;
  PhysicalModel model = cubic_lattice(lattice);
  model.object.contact_share = 0.0;
  return model;
}

void centre(PhysicalModel& model) {
  Vec3 moment = Vec3::Zero();
  double mass = 0.0;
  for (PointId p : ids_of(model.points)) {
    moment += model.points[p].mass * model.geometry.points[p];
    mass += model.points[p].mass;
  }
  for (Vec3& position : model.geometry.points) position -= moment / mass;
}

void break_either_way(PhysicalModel& model, double threshold) {
  for (EdgeAttributes& edge : model.edges) {
    edge.break_threshold = edge.crush_threshold = threshold;
  }
}

}  // namespace limber::reference
