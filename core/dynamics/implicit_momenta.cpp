#include "core/dynamics/implicit_momenta.h"

#include <algorithm>
#include <cmath>

#include "core/model/disjoint_sets.h"

namespace limber {
namespace {

// The largest share s <= 1 for which s linear + s^2 square <= budget; square >= 0.
double affordable_share(double linear, double square, double budget) {
  if (linear + square <= budget) return 1.0;
  if (budget <= 0.0 || square <= 0.0) return 0.0;
  const double half = 0.5 * linear;
  return std::clamp((std::sqrt(half * half + square * budget) - half) / square, 0.0, 1.0);
}

Mat3 turned_by(const Vec3& rotation_rad) {
  const double angle = rotation_rad.norm();
  if (!(angle > 0.0)) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, rotation_rad / angle).toRotationMatrix();
}

}  // namespace

std::vector<std::vector<std::int32_t>> free_pieces(const ImplicitSystem& system) {
  const std::size_t rows = system.points().size();
  DisjointSets sets(rows);
  const std::span springs(system.couplings().data(), system.springs().size());
  for (const Coupling& c : springs) {
    if (c.b >= 0) sets.join(c.a, c.b);
  }
  std::vector<char> held(rows, false);
  for (const Coupling& c : springs) {
    if (c.b < 0) held[sets.root(c.a)] = true;
  }
  std::vector<std::vector<std::int32_t>> of_root(rows), pieces;
  for (std::size_t row = 0; row < rows; ++row) {
    of_root[sets.root(static_cast<std::int32_t>(row))].push_back(system.points()[row]);
  }
  for (std::size_t root = 0; root < rows; ++root) {
    if (!held[root] && !of_root[root].empty()) pieces.push_back(std::move(of_root[root]));
  }
  return pieces;
}

void move_rigidly(Lattice& lattice, std::span<const std::int32_t> piece, double dt) {
  const RigidMotion body = rigid_motion(lattice.motion, lattice.mass, piece);
  const Mat3 turn = turned_by(dt * body.angular_velocity);
  for (std::int32_t p : piece) {
    PointMotion& motion = lattice.motion[p];
    const Vec3 arm = motion.position - body.centre;
    motion.velocity = body.velocity + (turn * arm - arm) / dt;
    motion.position += dt * motion.velocity;
  }
}

Momenta earned_momenta(const Lattice& lattice, const ImplicitSystem& system,
                       std::span<const std::int32_t> piece, const ImplicitForces& forces) {
  double mass = 0.0;
  Vec3 centre = Vec3::Zero();
  Momenta earned;
  for (std::int32_t p : piece) {
    const PointMotion& start = forces.start()[system.row(p)];
    mass += lattice.mass[p];
    centre += lattice.mass[p] * start.position;
    earned.linear += lattice.mass[p] * start.velocity;
  }
  centre /= mass;
  const Vec3 velocity = earned.linear / mass;
  for (std::int32_t p : piece) {
    const std::int32_t row = system.row(p);
    const PointMotion& start = forces.start()[row];
    const Vec3 impulse = forces.dt() * forces.constant().segment<3>(3 * row);
    const Vec3 momentum = lattice.mass[p] * (start.velocity - velocity) + impulse;
    earned.linear += impulse;
    earned.angular += (start.position - centre).cross(momentum);
  }
  return earned;
}

void restore_momentum(Lattice& lattice, std::span<const std::int32_t> piece, const Momenta& earned,
                      double dt) {
  double mass = 0.0;
  Vec3 missing = earned.linear;
  for (std::int32_t p : piece) {
    mass += lattice.mass[p];
    missing -= lattice.mass[p] * lattice.motion[p].velocity;
  }
  const Vec3 change = missing / mass;
  for (std::int32_t p : piece) {
    lattice.motion[p].velocity += change;
    lattice.motion[p].position += dt * change;
  }
}

double restore_spin(Lattice& lattice, std::span<const std::int32_t> piece, const Momenta& earned,
                    double budget) {
  const RigidMotion body = rigid_motion(lattice.motion, lattice.mass, piece);
  const Vec3 spin = angular_velocity_of(body.inertia, earned.angular - body.angular_momentum);
  const double linear = spin.dot(body.angular_momentum);
  const double square = 0.5 * spin.dot(body.inertia * spin);
  const double share = affordable_share(linear, square, budget);
  for (std::int32_t p : piece) {
    PointMotion& motion = lattice.motion[p];
    motion.velocity += (share * spin).cross(motion.position - body.centre);
  }
  return share * (linear + share * square);
}

}  // namespace limber
