#pragma once

#include <span>
#include <vector>

#include "bullet_bridge/contact_shape.h"
#include "bullet_bridge/support_contacts.h"
#include "core/contact/penalty.h"
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

// Lattice points against Bullet's bodies at the substep rate (the coupling of the time operator).
// Contract, per tick: begin_tick() copies the bodies near the lattice, and what supports them, into
// shadows; the substeps exchange equal and opposite forces between points and shadows;
// write_velocities() gives Bullet the result before it solves; correct_poses() after it moved.
// Bullet owns every mass outside of the lattice, this owns nothing beyond the tick.
class ContactSolver : public SubstepCoupling {
 public:
  // `near`: bodies whose shapes lattice points may reach in this tick, in a fixed order.
  void begin_tick(btDiscreteDynamicsWorld& world, const Lattice& lattice,
                  std::span<const btCollisionObject* const> near,
                  std::span<const CarriedPiece> carried);

  void add_forces(Lattice& lattice, double dt) override;
  void advance(Lattice& lattice, double dt) override;

  // Only bodies that were pushed are written and woken; the rest of Bullet's world keeps its bits.
  void write_velocities(btDiscreteDynamicsWorld& world, double tick);
  void correct_poses(double tick);

  // Did the lattice push the body in this tick, directly or through others?
  bool touched(const btCollisionObject& body) const;

 private:
  struct Candidate {
    std::int32_t point;
    std::int32_t part;
    double offset;  // m of penetration that was there when the pair was first seen
  };
  struct Obstacle {
    int shadow;
    const btCollisionObject* object;
    bool at_rest;                       // immovable and not moving: parts are in world coordinates
    std::vector<ContactPart> parts;     // otherwise in the body's frame
    std::vector<PenaltyContact> laws;   // against each object of the lattice
    std::vector<Candidate> candidates;  // ascending by (point, part)
  };

  Obstacle make_obstacle(const btCollisionObject& object, const Lattice& lattice);
  Vec3 to_obstacle_frame(const Obstacle& obstacle, const Vec3& point) const;
  void list_candidates(const Lattice& lattice, double dt);
  void list_candidates_of(Obstacle& obstacle, const Lattice& lattice, double least_reach,
                          double time);
  void push(Lattice& lattice, const Obstacle& obstacle, Candidate& candidate, double dt);
  void give_back_offsets();
  void pass_on_carried_forces(const Lattice& lattice);
  void move_carried_points(Lattice& lattice) const;

  ShadowSet shadows_;
  std::vector<SupportGroup> supports_;
  std::vector<Obstacle> obstacles_;
  std::vector<CarriedPiece> carried_;
  std::vector<int> carried_shadow_;
  std::vector<bool> supported_;  // by shadow: has support contacts, so that Bullet adds its gravity
  std::vector<Obstacle> last_tick_;  // to find again what was in contact
  int substep_ = 0;
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
