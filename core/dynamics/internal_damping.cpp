#include "core/dynamics/internal_damping.h"

#include <algorithm>
#include <cmath>

namespace limber {
namespace {

// Pieces that a pin holds: their points have no common rigid motion to be drawn to.
std::vector<bool> pinned_pieces(const Lattice& lattice, const Components& pieces) {
  std::vector<bool> pinned(pieces.count, false);
  for (std::int32_t p : lattice.dynamic_points) {
    if (lattice.inverse_mass[p] == 0.0) pinned[pieces.label[p]] = true;
  }
  return pinned;
}

// Where the point was when it had its velocity, m.
Vec3 position_of(const Lattice& lattice, std::int32_t p, std::span<const double> lead) {
  const auto& [position, velocity] = lattice.motion[p];
  if (lead.empty()) return position;
  return position - lead[lattice.point_object[p]] * velocity;
}

// rigid_motion() of every piece in two passes over the points.
std::vector<RigidMotion> rigid_motions(const Lattice& lattice, const Components& pieces,
                                       std::span<const double> lead) {
  std::vector<RigidMotion> bodies(pieces.count);
  for (std::int32_t p : lattice.dynamic_points) {
    RigidMotion& body = bodies[pieces.label[p]];
    body.mass += lattice.mass[p];
    body.centre += lattice.mass[p] * position_of(lattice, p, lead);
    body.velocity += lattice.mass[p] * lattice.motion[p].velocity;
  }
  for (RigidMotion& body : bodies) {
    body.centre /= body.mass;
    body.velocity /= body.mass;
  }
  for (std::int32_t p : lattice.dynamic_points) {
    RigidMotion& body = bodies[pieces.label[p]];
    const Vec3 r = position_of(lattice, p, lead) - body.centre;
    const double m = lattice.mass[p];
    body.angular_momentum += m * r.cross(lattice.motion[p].velocity - body.velocity);
    body.inertia += m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  for (RigidMotion& body : bodies) {
    body.angular_velocity = angular_velocity_of(body.inertia, body.angular_momentum);
  }
  return bodies;
}

}  // namespace

double damp_internally(Lattice& lattice, const Components& pieces, double t,
                       std::span<const double> lead) {
  const auto undamped = [](const LatticeObject& object) {
    return object.authored.object.internal_damping == 0.0;
  };
  if (std::all_of(lattice.objects.begin(), lattice.objects.end(), undamped)) return 0.0;
  std::vector<double> share(lattice.objects.size());
  for (std::size_t o = 0; o < share.size(); ++o) {
    share[o] = -std::expm1(-lattice.objects[o].authored.object.internal_damping * t);
  }
  const std::vector<RigidMotion> bodies = rigid_motions(lattice, pieces, lead);
  const std::vector<bool> pinned = pinned_pieces(lattice, pieces);
  double loss = 0.0;
  for (std::int32_t p : lattice.dynamic_points) {
    if (pinned[pieces.label[p]]) continue;
    const std::int32_t object = lattice.point_object[p];
    const double s = share[object];
    auto& [x, v] = lattice.motion[p];
    const Vec3 vibration = v - bodies[pieces.label[p]].velocity_at(position_of(lattice, p, lead));
    loss += 0.5 * lattice.mass[p] * (1.0 - (1.0 - s) * (1.0 - s)) * vibration.squaredNorm();
    v -= s * vibration;
    if (!lead.empty()) x -= (lead[object] * s) * vibration;
  }
  return loss;
}

}  // namespace limber
