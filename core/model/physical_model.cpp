#include "core/model/physical_model.h"

#include <cassert>

#include "core/model/errors.h"

namespace limber {

PhysicalModel with_default_attributes(GeometricModel geometry, std::string name) {
  PhysicalModel model;
  model.name = std::move(name);
  model.geometry = std::move(geometry);
  const GeometricModel& g = model.geometry;
  model.points.resize(g.points.size());
  model.edges.resize(g.edges.size());
  model.faces.resize(g.faces.size());
  model.cells.resize(g.cells.size());
  model.parts.resize(g.subobjects.size());
  for (EdgeId e : ids_of(g.edges)) {
    const auto& [a, b] = g.edges[e];
    assert(g.points.contains(a) && g.points.contains(b));
    model.edges[e].rest_length = (g.points[b] - g.points[a]).norm();
  }
  return model;
}

void place(PhysicalModel& model, const Mat3& rotation, const Vec3& translation_m) {
  // A mirror or a scale would leave rest lengths or orientations behind.
  assert((rotation * rotation.transpose() - Mat3::Identity()).norm() < 1e-9);
  assert(rotation.col(0).cross(rotation.col(1)).dot(rotation.col(2)) > 0.0);
  for (Vec3& x : model.geometry.points) x = rotation * x + translation_m;
  for (PointAttributes& point : model.points) point.velocity = rotation * point.velocity;
}

double total_mass(const PhysicalModel& model) {
  double mass = 0.0;
  for (const PointAttributes& point : model.points) mass += point.mass;
  return mass;
}

Vec3 centre_of_mass(const PhysicalModel& model) {
  const double mass = total_mass(model);
  Vec3 moment = Vec3::Zero();
  for (PointId p : ids_of(model.points)) moment += model.points[p].mass * model.geometry.points[p];
  if (mass > 0.0) return moment / mass;
  throw InputError({model.name + ": points",
                    "P2 their mass adds up to " + std::to_string(mass) + " kg",
                    "give every point a mass before you ask for its centre or set it in motion"});
}

void set_in_motion(PhysicalModel& model, const Vec3& velocity_m_s, const Vec3& omega_rad_s,
                   const Vec3& centre_m) {
  for (PointId p : ids_of(model.points))
    model.points[p].velocity +=
        velocity_m_s + omega_rad_s.cross(model.geometry.points[p] - centre_m);
}

void set_in_motion(PhysicalModel& model, const Vec3& velocity_m_s, const Vec3& omega_rad_s) {
  set_in_motion(model, velocity_m_s, omega_rad_s, centre_of_mass(model));
}

}  // namespace limber
