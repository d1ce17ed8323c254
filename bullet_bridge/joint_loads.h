#pragma once

#include <BulletDynamics/ConstraintSolver/btTypedConstraint.h>

#include <vector>

#include "bullet_bridge/piece_index.h"

class btDiscreteDynamicsWorld;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// What a game's constraints bear at pieces. Bullet sums a constraint's force only where that has a
// btJointFeedback; those that have none get one while Bullet solves and lose it afterwards.
class JointLoads {
 public:
  // Before Bullet solves.
  void begin(btDiscreteDynamicsWorld& world, const PieceIndex& index);

  // After. Adds to the pieces' joint_load: the magnitude of each constraint's force, and that of
  // the forces at the ends of half the piece's size that make its couple.
  void end();

 private:
  struct Entry {
    btTypedConstraint* joint;
    Piece* a;  // null: no piece
    Piece* b;
    btJointFeedback feedback;
    bool lent;
  };
  std::vector<Entry> entries_;
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
