#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bullet_bridge/rigid_proxy.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// The books of one change of representation, both sides measured on their own: the lattice from its
// points, the body from what Bullet holds.
struct HandOver {
  bool to_flexible = false;
  double momentum_defect_rel = 0.0;          // |P' - P| / sum m|v|
  double angular_momentum_defect_rel = 0.0;  // |L' - L| / sum m|r||v|, about the centre of mass
  double kinetic_before_J = 0.0;
  double kinetic_after_J = 0.0;
  double elastic_J = 0.0;    // in the springs, on either side: stored while rigid
  double discarded_J = 0.0;  // vibration, zero when turning flexible
  // Kinetic energy that a piece on a line loses (and gets back) because Bullet needs a moment of
  // inertia about the line that its points do not have; P and L are kept all the same.
  double regularised_J = 0.0;
  double unaccounted_rel = 0.0;  // |before - after - discarded - regularised| / before
};

// The state of a lattice as a body, and the books as far as the lattice's side goes.
RigidState take_state(const Lattice& lattice, std::span<const std::int32_t> points,
                      HandOver& books);

// A lattice becomes a body with its P, L and centre of mass. The deformed shape stays, and with it
// the elastic energy; the vibration's kinetic energy is lost. Points keep their place until thaw().
// `body`: what has stood for the lattice.
HandOver freeze(btDiscreteDynamicsWorld& world, const Lattice& lattice,
                std::span<const std::int32_t> points, std::unique_ptr<RigidProxy>& proxy,
                std::shared_ptr<PieceBody> body = {});

// A body becomes a lattice again: x_i = X + R r_i, v_i = V + omega x R r_i, with V and omega such
// that the points have the body's P and L to rounding (Bullet's own numbers may be floats). The
// proxy is not removed.
HandOver thaw(Lattice& lattice, std::span<const std::int32_t> points, const RigidProxy& proxy);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
