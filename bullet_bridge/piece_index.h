#pragma once

#include <memory>
#include <vector>

#include "bullet_bridge/piece.h"

class btCollisionObject;
class btCollisionWorld;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// Which pieces a tick has to look at, and which of them a body stands for. A sleeping proxy costs
// Bullet a quarter of a microsecond a tick: there is no room in that for a hash or a look at its
// loads.
class PieceIndex {
 public:
  using Pieces = std::vector<std::unique_ptr<Piece>>;

  // Pieces came, went, or changed their representation.
  void pieces_changed() { stale_ = true; }

  // At a tick's start: Bullet's bodies may have fallen asleep, or stand elsewhere in its array.
  void begin_tick(const Pieces& pieces, const btCollisionWorld& world);

  // Rigid at the tick's start, with a body that was awake. Some may have turned flexible since.
  const std::vector<Piece*>& awake() const { return awake_; }

  // Flexible now, ascending by id. A copy: who goes through it may change representations.
  std::vector<Piece*> flexible(const Pieces& pieces);

  // kg, of all pieces.
  double mass(const Pieces& pieces);

  // The rigid piece that the body stands for; null for none. Between begin_tick() and the next
  // change of the world's bodies.
  Piece* rigid(const btCollisionObject& body) const;

  // The piece that the body stands for, in either representation; likewise.
  Piece* any(const btCollisionObject& body) const;

 private:
  struct Rigid {
    const btCollisionObject* body;
    Piece* piece;
  };
  void refresh(const Pieces& pieces);
  bool note_place(const btCollisionObject& body, Piece* piece);

  bool stale_ = true;
  std::vector<Rigid> rigid_;
  std::vector<Piece*> flexible_, awake_;
  double mass_ = 0.0;
  std::vector<Piece*> by_place_;  // in the world's array of bodies
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
