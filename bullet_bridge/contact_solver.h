#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "bullet_bridge/contact_clusters.h"
#include "bullet_bridge/neighbourhood.h"
#include "bullet_bridge/obstacle.h"
#include "bullet_bridge/push.h"
#include "bullet_bridge/shapes/shape_cache.h"
#include "bullet_bridge/support_contacts.h"
#include "core/operators/boundary_tracker.h"
#include "core/operators/time_operator.h"

class btDiscreteDynamicsWorld;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A rigid proxy near flexible pieces. Its surface towards lattices are its own points, moved by its
// shadow; so one and the same contact law holds whichever representation a piece is in.
struct CarriedPiece {
  const btCollisionObject* body = nullptr;
  std::span<const std::int32_t> points;
  std::span<const Vec3> local;  // positions of the points in the body's frame, m
};

// Lattices against Bullet's bodies at the substep rate (the coupling of the time operator).
// Contract, per tick: begin_tick() copies the bodies near the lattice, and what supports them, into
// shadows; the substeps exchange equal and opposite forces between points and shadows;
// write_velocities() gives Bullet the result before it solves; correct_poses() after it moved.
// Bullet owns every mass outside of the lattice. What this keeps beyond the tick is what contacts
// remember: sides, books and friction.
class ContactSolver : public SubstepCoupling {
 public:
  // Does Bullet give the bodies this tick's gravity after the substeps, or has it done so?
  enum class Gravity { kToCome, kGiven };

  // `near`: bodies that the lattice may reach in this tick, in a fixed order. `boundary` and
  // `pieces` have to follow the lattice's breaks.
  void begin_tick(btDiscreteDynamicsWorld& world, const BoundaryTracker& boundary,
                  const Components& pieces, std::span<const NearBody> near,
                  std::span<const CarriedPiece> carried, Gravity gravity, double tick);

  // In a tick without lattices: what contacts remembered is no longer true.
  void forget() {
    obstacles_.clear();
    shadows_ = {};
  }

  // The body has left the world.
  void forget(const btCollisionObject& body) { shadows_.forget(body); }

  // The body is no longer one: its pose and flags are not this solver's business any more.
  void let_go(const btCollisionObject& object);

  // A piece turns rigid: keeps what its contacts remember. It turns into a lattice again: gives
  // that to the solver that goes on with it, from its next tick on. Or is gone.
  void keep(std::size_t piece, std::span<const std::int32_t> points);
  std::vector<Obstacle> give_up(std::size_t piece);
  void take_up(std::vector<Obstacle> kept);

  // From the next tick on this goes on with the contacts of the other too, which are of other
  // points.
  void take_over(ContactSolver&& other);

  // Forces besides, for this tick. After begin_tick().
  void bear(std::vector<PointLoad> loads) { loads_ = std::move(loads); }

  void add_forces(Lattice& lattice, double dt) override;
  void advance(Lattice& lattice, double dt) override;

  // Only bodies that were pushed are written and woken; the rest of Bullet's world keeps its bits.
  void write_velocities(btDiscreteDynamicsWorld& world, double tick);
  void correct_poses(double tick);

  // Did the lattice push the body in this tick, directly or through others?
  bool touched(const btCollisionObject& body) const;

  // What lattices and bodies did to one another in this tick, in the order of the bodies. Once.
  struct BodyPush {
    const btCollisionObject* body;
    ObjectPush push;
  };
  std::vector<BodyPush> take_pushes(const Lattice& lattice);

  // N, shape (P): how hard bodies press points just now, whatever the direction; what presses a
  // face is with one of its corners.
  std::vector<double> contact_loads(const Lattice& lattice) const;

  // Points, shape (P), that have sunk into bodies and are on their way out still: what has them is
  // not at rest, however steadily it moves.
  std::vector<std::uint8_t> yielding_points(const Lattice& lattice) const;

 private:
  void list_pairs(const Lattice& lattice, double dt);
  void go_on_with_due(const Lattice& lattice);
  void press(Lattice& lattice, const ContactCluster& cluster, double dt);
  void pass_on_carried_forces(const Lattice& lattice);
  void move_carried_points(Lattice& lattice) const;

  ShadowSet shadows_;
  std::vector<SupportGroup> supports_;
  std::vector<Obstacle> obstacles_;
  std::map<std::size_t, std::vector<Obstacle>> kept_;  // of rigid pieces, by their id
  std::vector<Obstacle> due_;  // of what has just turned into a lattice again
  std::vector<PointLoad> loads_;
  std::vector<CarriedPiece> carried_;
  std::vector<int> carried_shadow_;
  std::vector<bool> supported_;  // by shadow: stands on something, so that Bullet adds its gravity
  std::vector<ContactCluster> clusters_;
  const BoundaryTracker* boundary_ = nullptr;
  const Components* pieces_ = nullptr;
  LatticeSurface surface_;
  ShapeCache shapes_;
  Gravity gravity_ = Gravity::kToCome;
  int substep_ = 0;
  double dt_ = 0.0;  // s, of the last substep
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
