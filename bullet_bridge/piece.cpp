#include "bullet_bridge/piece.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/live_springs.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

double lattice_factor(const LatticeObject& object) {
  if (object.cells.size() > 0) return 6.0;
  return object.faces.size() > 0 ? 3.0 : 1.0;
}

}  // namespace

PieceStrength strength_of(const Lattice& lattice, std::span<const std::int32_t> points) {
  PieceStrength strength;
  strength.weakest_strain = kUnbreakable;
  double stiffness = 0.0;  // sum k l^2, N m
  for (std::int32_t p : points) strength.mass += lattice.mass[p];
  for_each_live_spring(lattice, points, [&](const Spring& s) {
    stiffness += s.stiffness * s.rest_length * s.rest_length;
    strength.weakest_strain = std::min({strength.weakest_strain, s.break_threshold / s.rest_length,
                                        s.crush_threshold / s.rest_length});
  });
  const LatticeObject& object = lattice.objects[lattice.point_object[points[0]]];
  strength.wave_speed = std::sqrt(stiffness / (lattice_factor(object) * strength.mass));
  return strength;
}

double rms_vibration(const Lattice& lattice, std::span<const std::int32_t> points) {
  const RigidMotion motion = rigid_motion(lattice.motion, lattice.mass, points);
  double sum = 0.0;
  for (std::int32_t p : points) {
    const PointMotion& point = lattice.motion[p];
    sum += lattice.mass[p] * (point.velocity - motion.velocity_at(point.position)).squaredNorm();
  }
  return std::sqrt(sum / motion.mass);
}

double contact_load(const Lattice& lattice, std::span<const std::int32_t> points,
                    const Vec3& gravity_m_s2, const Vec3& air_force) {
  Vec3 force = -air_force;
  for (std::int32_t p : points) force += lattice.force[p] - lattice.mass[p] * gravity_m_s2;
  return force.norm();
}

double largest_load(const Lattice& lattice, std::span<const std::int32_t> points) {
  double largest = 0.0;
  for_each_live_spring(lattice, points, [&](const Spring& s) {
    const double stretch = stretch_of(lattice, s);
    largest = std::max({largest, stretch / s.break_threshold, -stretch / s.crush_threshold});
  });
  return largest;
}

void measure(Piece& piece, const Lattice& lattice) {
  piece.strength = strength_of(lattice, piece.points);
  const Vec3 centre = rigid_motion(lattice.motion, lattice.mass, piece.points).centre;
  double farthest = 0.0;
  for (std::int32_t p : piece.points) {
    farthest = std::max(farthest, (lattice.motion[p].position - centre).norm());
  }
  piece.size = 2.0 * farthest;
  double longest = 0.0;
  for_each_live_spring(lattice, piece.points,
                       [&](const Spring& s) { longest = std::max(longest, s.rest_length); });
  piece.face_reach = longest / std::sqrt(3.0);  // the radius around an equilateral triangle
  piece.pinned = std::any_of(piece.points.begin(), piece.points.end(),
                             [&](std::int32_t p) { return lattice.inverse_mass[p] == 0.0; });
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
