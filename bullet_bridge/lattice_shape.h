#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/dynamics/lattice.h"
#include "core/operators/boundary_tracker.h"

class btCollisionObject;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// The surface of a flexible piece as a collision shape, for Bullet's queries: rays, sweeps, contact
// tests and debug drawing. The index of a triangle that a query reports is that of the face in the
// object's model. Ropes have no faces and are hit by nothing.
//
// Triangles are only gathered when somebody asks, once a tick. Like all of Bullet's queries, this
// is for one thread.
class LatticeShape : public btConcaveShape {
 public:
  // `points`: of the piece, ascending. Lattice and boundary must outlive this.
  LatticeShape(const Lattice& lattice, const BoundaryTracker& boundary,
               std::span<const std::int32_t> points);

  // The points have moved; `frame` is that of the body now.
  void follow(const Vec3& centre, const Mat3& rotation);

  // From the next question for the bounding box on this body is static; null: none is.
  void make_static_when_asked(btCollisionObject* body) { becomes_static_ = body; }

  void processAllTriangles(btTriangleCallback* callback, const btVector3& low,
                           const btVector3& high) const override;
  void getAabb(const btTransform& pose, btVector3& low, btVector3& high) const override;
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  void setLocalScaling(const btVector3&) override {}  // a lattice is as large as it is
  const btVector3& getLocalScaling() const override { return unscaled_; }
  const char* getName() const override { return "LatticeShape"; }

 private:
  // Neighbours in the model, mostly, and a box around them.
  struct Block {
    btVector3 low, high;
    std::size_t begin, end;  // of triangles_
  };
  void list_faces() const;
  void gather() const;
  btVector3 local(const Vec3& place) const;

  const Lattice& lattice_;
  const BoundaryTracker& boundary_;
  std::vector<std::int32_t> points_;
  Vec3 centre_ = Vec3::Zero();
  Mat3 to_local_ = Mat3::Identity();
  btVector3 low_, high_;  // of the points, in the body's frame
  btVector3 unscaled_;
  btCollisionObject* becomes_static_ = nullptr;

  mutable bool listed_ = false, gathered_ = false;
  mutable std::uint64_t revision_ = 0;       // of the boundary, of faces_
  mutable std::vector<std::int32_t> faces_;  // ascending
  mutable std::vector<std::array<btVector3, 3>> triangles_;
  mutable std::vector<Block> blocks_;
};

// Does the object stand for a flexible piece? Its contact is the lattice's, not its shape's.
bool stands_for_lattice(const btCollisionObject& object);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
