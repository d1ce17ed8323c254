#pragma once

#include <LinearMath/btTransform.h>

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bullet_bridge/piece_body.h"
#include "bullet_bridge/proxy_frame.h"
#include "bullet_bridge/proxy_shape.h"
#include "core/dynamics/lattice.h"
#include "core/environment/rigid_flight.h"

class btDiscreteDynamicsWorld;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// The state of a piece as a rigid body, from its deformed points.
struct RigidState {
  RigidMotion motion;
  ProxyFrame frame;
  std::vector<Vec3> local;  // shape (points), m: where they are in the frame
};
RigidState rigid_state(const Lattice& lattice, std::span<const std::int32_t> points);

// The rigid body that stands for a piece in Bullet's world while nothing stresses it. The deformed
// shape is kept: point i of the piece is at centre + R local[i].
class RigidProxy {
 public:
  // `state`: of these points. `body`: what has stood for the piece so far, if anything did.
  RigidProxy(btDiscreteDynamicsWorld& world, const Lattice& lattice,
             std::span<const std::int32_t> points, RigidState state,
             std::shared_ptr<PieceBody> body = {});
  RigidProxy(const RigidProxy&) = delete;
  RigidProxy& operator=(const RigidProxy&) = delete;

  PieceBody& body() const { return *body_; }
  std::shared_ptr<PieceBody> shared_body() const { return body_; }
  std::span<const Vec3> local() const { return local_; }

  // Of its shape from its centre, m, at most.
  double reach() const { return reach_; }

  // Puts the points where the body carries them: x = X + R r, v = V + omega x R r.
  void write_points(Lattice& lattice, std::span<const std::int32_t> points) const;

  // Was a moment of inertia raised for Bullet (kSmallestMomentShare)?
  bool regularised() const { return regularised_; }

  // The body's motion as Bullet holds it, with the exact mass and moments (Bullet's may be floats).
  RigidMotion motion() const;

  // The same wind as its lattice would feel. Computes the flight through the air over the tick to
  // come and gives the body what the air changes of its velocities in that time. Between remember()
  // and the solver. Returns the mean force of the air, N, in the body's frame.
  bool feels_air() const { return !flying_.faces.empty(); }
  Vec3 feel_air(const Air& air, double time, double tick);

  // Force of the air as the body is now, N, in its frame.
  Vec3 air_force(const Air& air, double time) const;
  Vec3 to_world(const Vec3& of_body) const;

  // Free flight. Bullet's step x += v' dt falls g t dt / 2 too far and keeps omega where it should
  // keep L. remember() before the solver, fly() after the move: the path of constant acceleration
  // x += (v + v') dt / 2, and the rotation of a free body. The rotation goes on in double as long
  // as nobody else changes the body. A body that feels the air goes where feel_air() had it go.
  // What a game's own forces and torques changed of the velocities in this tick comes on top.
  void remember();
  void fly(double tick);

  double impulse = 0.0;  // N s, magnitude of all contact impulses of the last tick

 private:
  // Where it was at the tick's start, and how it moved.
  struct Start {
    Vec3 position, velocity;  // m, m/s
    Eigen::Quaterniond orientation;
    Vec3 angular_velocity;  // rad/s
  };
  Start start() const;
  FlightState start_of_flight() const;

  std::vector<Vec3> local_;                // shape (points)
  FlyingBody flying_;                      // with the faces that feel the air
  std::optional<FlightState> flight_end_;  // of this tick
  ProxyShape shape_;
  std::shared_ptr<PieceBody> body_;
  double reach_ = 0.0;
  double mass_ = 0.0;
  Vec3 moments_;
  bool regularised_ = false;
  // As Bullet holds it: most bodies rest, and nobody asks.
  btTransform start_pose_;
  btVector3 start_velocity_, start_angular_velocity_;
  Eigen::Quaterniond flown_orientation_;  // exact, of the last flight
  Vec3 flown_angular_velocity_;
  btMatrix3x3 written_basis_;  // what Bullet was given for them
  btVector3 written_angular_velocity_;
  btVector3 foreseen_angular_velocity_;  // Bullet's after solving, if nothing turns the body
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
