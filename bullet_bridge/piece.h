#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bullet_bridge/lattice_body.h"
#include "bullet_bridge/rigid_proxy.h"
#include "bullet_bridge/switch_policy.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A connected piece of an object, in either representation.
struct Piece {
  std::size_t id = 0;
  std::size_t object = 0;
  std::vector<std::int32_t> points;  // of the lattice, ascending
  PieceStrength strength;
  double size = 0.0;                  // m, twice the distance of the farthest point
  double face_reach = 0.0;            // m, of any place on its faces from the nearest point
  std::unique_ptr<RigidProxy> proxy;  // null while flexible
  std::unique_ptr<LatticeBody> seen;  // null while rigid
  double stored_J = 0.0;              // elastic energy, while rigid
  bool counted = false;               // its proxy's impulse is of this tick already
  double joint_load = 0.0;            // N, of the game's constraints in the last tick
  double carried_load = 0.0;          // N, of contacts and joints when it became rigid
  double sustained_load = 0.0;        // N, of them since then, averaged over time
  Vec3 carried_air = Vec3::Zero();    // N, force of the air then, in the body's frame
  Vec3 air_load = Vec3::Zero();       // N, its mean in the last tick, in the body's frame
  int calm_ticks = 0;                 // while flexible
  double peak_load = 0.0;             // of the last tick, while flexible
  bool touched = false;               // by anything since it turned flexible
  bool pinned = false;                // holds a pinned point, and stays flexible

  bool flexible() const { return proxy == nullptr; }
  btRigidBody& body() const { return proxy ? proxy->body() : seen->body(); }
};

// Strength from the live springs. The wave speed comes from the lattice itself: for an isotropic
// lattice of central forces sum k l^2 / V = C_iijj = 15 (2/5) E = 6 E in three dimensions, 3 E in
// two and E in one, so that c = sqrt(E / rho) = sqrt(sum k l^2 / (d M)) with d = 6, 3, 1.
PieceStrength strength_of(const Lattice& lattice, std::span<const std::int32_t> points);

// Root mean square speed about the piece's rigid motion, m/s.
double rms_vibration(const Lattice& lattice, std::span<const std::int32_t> points);

// Magnitude of the contact forces on the piece in the last substep, N: what gravity, the air (N, on
// the whole piece) and the springs, which cancel, leave of the force on its points.
double contact_load(const Lattice& lattice, std::span<const std::int32_t> points,
                    const Vec3& gravity_m_s2, const Vec3& air_force);

// Largest share of its threshold that one of the unbroken springs bears as the points are now.
double largest_load(const Lattice& lattice, std::span<const std::int32_t> points);

// Fills strength, sizes and pinned from the points.
void measure(Piece& piece, const Lattice& lattice);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
