#include "tests/reference/readings.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/dynamics/spring_force.h"

namespace limber::reference {
namespace {

SpringStretch state_of(const Lattice& lattice, std::size_t edge) {
  const Spring& s = lattice.springs[edge];
  const PointMotion &a = lattice.motion[s.a], &b = lattice.motion[s.b];
  return spring_stretch(b.position - a.position, b.velocity - a.velocity, s.rest_length);
}

}  // namespace

Lattice compiled(std::vector<PhysicalModel> models) {
  Lattice lattice;
  for (PhysicalModel& model : models) add_object(lattice, std::move(model));
  rebuild_active(lattice);
  return lattice;
}

Lattice compiled(PhysicalModel model) {
  std::vector<PhysicalModel> models;
  models.push_back(std::move(model));
  return compiled(std::move(models));
}

std::vector<std::int32_t> all_points(const Lattice& lattice) {
  std::vector<std::int32_t> points(lattice.motion.size());
  std::iota(points.begin(), points.end(), 0);
  return points;
}

std::vector<std::int32_t> free_points(const Lattice& lattice) {
  std::vector<std::int32_t> points;
  for (std::int32_t p : all_points(lattice)) {
    if (lattice.inverse_mass[p] > 0.0) points.push_back(p);
  }
  return points;
}

std::vector<Vec3> positions(const Lattice& lattice) {
  std::vector<Vec3> x;
  for (const PointMotion& point : lattice.motion) x.push_back(point.position);
  return x;
}

std::vector<Vec3> velocities(const Lattice& lattice) {
  std::vector<Vec3> v;
  for (const PointMotion& point : lattice.motion) v.push_back(point.velocity);
  return v;
}

RigidMotion rigid_motion(const Lattice& lattice) {
  return limber::rigid_motion(lattice.motion, lattice.mass, all_points(lattice));
}

Mat3 rotation(const Lattice& lattice) {
  return best_rotation(lattice.motion, lattice.authored_position, lattice.mass,
                       all_points(lattice));
}

double kinetic_energy(const Lattice& lattice) {
  return limber::kinetic_energy(lattice.motion, lattice.mass, all_points(lattice));
}

double elastic_energy(const Lattice& lattice) {
  return limber::elastic_energy(lattice, all_points(lattice));
}

double energy(const Lattice& lattice) { return kinetic_energy(lattice) + elastic_energy(lattice); }

double energy_about_centre(const Lattice& lattice) {
  const RigidMotion body = rigid_motion(lattice);
  return energy(lattice) - 0.5 * body.mass * body.velocity.squaredNorm();
}

double stretch(const Lattice& lattice, std::size_t edge) { return state_of(lattice, edge).stretch; }

double stretch_rate(const Lattice& lattice, std::size_t edge) {
  return state_of(lattice, edge).rate;
}

double tension(const Lattice& lattice, std::size_t edge) {
  return spring_tension(lattice.springs[edge].stiffness, 0.0, stretch(lattice, edge), 0.0);
}

double largest_stretch(const Lattice& lattice) {
  double largest = 0.0;
  for (std::size_t e = 0; e < lattice.springs.size(); ++e) {
    if (lattice.breaking.edge_broken[e]) continue;
    largest = std::max(largest, std::abs(stretch(lattice, e)));
  }
  return largest;
}

double AngleCounter::count(double angle) {
  counted_ += std::remainder(angle - counted_, 2.0 * std::numbers::pi);
  return counted_;
}

}  // namespace limber::reference
