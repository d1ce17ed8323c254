#include "tests/reference/build.h"

#include <stdexcept>

#include "core/analysis/equilibrium.h"

namespace limber::reference {

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

void settle_or_throw(PhysicalModel& model, const Vec3& gravity) {
  if (!settle(model, gravity).converged) throw std::runtime_error("no equilibrium found");
}

}  // namespace limber::reference
