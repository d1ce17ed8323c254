#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <memory>
#include <span>

#include "bullet_bridge/precision.h"
#include "bullet_bridge/proxy_frame.h"
#include "core/dynamics/lattice.h"

class btDiscreteDynamicsWorld;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// What stands for a piece in Bullet's world as long as the piece exists, whichever its
// representation. A game may keep its address, give it a user pointer, a motion state, a filter
// group and joints, read and change its pose and velocities, push it, and query it.
//
// Rigid, it is a body like any other. As a lattice it has the lattice's surface for a shape, so
// that rays, sweeps and contact tests hit that; Bullet lets it collide with nothing and moves
// nothing of it, because contact and motion are the lattice's. It counts as static for Bullet then
// (islands would merge, and wake, whatever comes near), but for one with joints, which Bullet has
// to solve.
class PieceBody : public btRigidBody {
 public:
  PieceBody(btDiscreteDynamicsWorld& world, const btRigidBodyConstructionInfo& info);
  ~PieceBody() override;
  PieceBody(const PieceBody&) = delete;
  PieceBody& operator=(const PieceBody&) = delete;

  // Changes of representation. Bodies enter and leave the world: not while Bullet solves.
  void be_rigid(const ProxyFrame& frame, btCollisionShape& shape);
  void be_lattice(const ProxyFrame& frame, btCollisionShape& shape);  // where the frame says
  void be_lattice(btCollisionShape& shape);                           // where it is

  // While Bullet solves: nothing collides with it any more, and Bullet adds no gravity.
  void stop_being_rigid();

  // Of a lattice: does Bullet solve it?
  void bear_joints(bool joints);

  // Of a lattice that Bullet does not solve, between its steps: Bullet gives interpolated motion
  // states to what is not static. Once a step has begun it has to be static again, before Bullet
  // puts islands together; that it asks for the shape's bounding box is the sign (LatticeShape).
  void seem_movable() { setCollisionFlags(getCollisionFlags() & ~CF_STATIC_OBJECT); }

  // Of a lattice: moves with it, and so do the joints' frames in it.
  void follow(const ProxyFrame& frame);

  void leave();  // the world

  bool checkCollideWithOverride(const btCollisionObject* other) const override {
    return !lattice_ && btRigidBody::checkCollideWithOverride(other);
  }

 private:
  void enter();
  void take_frame(const ProxyFrame& frame);  // joints stay where they are in the world

  btDiscreteDynamicsWorld& world_;
  int group_ = 0, mask_ = 0;  // of the filter, when it left the world; 0: it never was in it
  int responses_ = 0;         // CF_NO_CONTACT_RESPONSE, if the game had set that
  bool lattice_ = false;
  bool never_sleeps_ = false;  // the game had DISABLE_DEACTIVATION set
};

// With the friction and restitution of the piece's object; it is in no world yet.
std::shared_ptr<PieceBody> make_piece_body(btDiscreteDynamicsWorld& world, const Lattice& lattice,
                                           std::span<const std::int32_t> points);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
