#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "bullet_bridge/lattice_shape.h"
#include "bullet_bridge/piece_body.h"
#include "bullet_bridge/push.h"
#include "bullet_bridge/rigid_proxy.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// What a game sees of a flexible piece, and what it does to it: a PieceBody that follows the
// lattice, and whose changes by others the lattice follows.
//
// Per tick: take_changes() before lattices are integrated (forces, impulses, velocities and
// teleports of the game); show_velocity() before Bullet solves and joint_impulse() after; show()
// after bodies moved.
class LatticeBody {
 public:
  // A piece that is flexible from the start, or since it came off another one. `heir`: the body of
  // what it came off. Not while Bullet solves.
  LatticeBody(btDiscreteDynamicsWorld& world, const Lattice& lattice,
              const BoundaryTracker& boundary, std::span<const std::int32_t> points,
              std::shared_ptr<PieceBody> heir = {});
  // A piece that turns flexible. While Bullet solves its shape is still the proxy's.
  LatticeBody(const Lattice& lattice, const BoundaryTracker& boundary,
              std::span<const std::int32_t> points, std::unique_ptr<RigidProxy> proxy);

  btRigidBody& body() const { return *body_; }
  std::shared_ptr<PieceBody> shared_body() const { return body_; }

  // Forces and changes of velocity move the points rigidly: where a force acts is lost in a body.
  // Returns whether somebody has put the body elsewhere.
  bool take_changes(Lattice& lattice, std::span<const std::int32_t> points, double tick);

  void show_velocity(const Lattice& lattice, std::span<const std::int32_t> points, double tick);

  // What joints did to the body since show_velocity().
  Impulse joint_impulse() const { return impulse_since(velocity_, angular_velocity_); }

  // Puts the body where the lattice is. `joints`: is it to bear some in the next tick?
  void show(btDiscreteDynamicsWorld& world, const Lattice& lattice,
            std::span<const std::int32_t> points, bool joints);

 private:
  Eigen::Quaterniond orientation_of(const Lattice& lattice,
                                    std::span<const std::int32_t> points) const;
  void note_orientation(const Lattice& lattice, std::span<const std::int32_t> points);
  void note_body();
  void teleport(Lattice& lattice, std::span<const std::int32_t> points) const;
  Impulse impulse_since(const btVector3& velocity, const btVector3& angular_velocity) const;

  std::unique_ptr<RigidProxy> proxy_;  // whose shape the body has until bodies may change
  LatticeShape shape_;
  std::shared_ptr<PieceBody> body_;
  Eigen::Quaterniond from_authored_;  // best rotation of the authored shape -> the body's frame
  // What the body held when it was last written.
  btTransform pose_;
  btVector3 velocity_, angular_velocity_;
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
