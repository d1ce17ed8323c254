#include "bullet_bridge/piece_index.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

void PieceIndex::refresh(const Pieces& pieces) {
  if (!stale_) return;
  stale_ = false;
  rigid_.clear();
  flexible_.clear();
  mass_ = 0.0;
  for (const auto& piece : pieces) {
    mass_ += piece->strength.mass;
    if (piece->flexible()) {
      flexible_.push_back(piece.get());
    } else {
      rigid_.push_back({&piece->body(), piece.get()});
    }
  }
}

void PieceIndex::begin_tick(const Pieces& pieces, const btCollisionWorld& world) {
  refresh(pieces);
  awake_.clear();
  by_place_.assign(static_cast<std::size_t>(world.getNumCollisionObjects()), nullptr);
  for (const Rigid& rigid : rigid_) {
    if (note_place(*rigid.body, rigid.piece) && rigid.body->isActive()) {
      awake_.push_back(rigid.piece);
    }
  }
  for (Piece* piece : flexible_) note_place(piece->body(), piece);
}

// Not in the world: the game has taken it out.
bool PieceIndex::note_place(const btCollisionObject& body, Piece* piece) {
  const auto place = static_cast<std::size_t>(body.getWorldArrayIndex());
  if (place >= by_place_.size()) return false;
  by_place_[place] = piece;
  return true;
}

std::vector<Piece*> PieceIndex::flexible(const Pieces& pieces) {
  refresh(pieces);
  return flexible_;
}

double PieceIndex::mass(const Pieces& pieces) {
  refresh(pieces);
  return mass_;
}

Piece* PieceIndex::rigid(const btCollisionObject& body) const {
  Piece* piece = any(body);
  return piece && !piece->flexible() ? piece : nullptr;
}

Piece* PieceIndex::any(const btCollisionObject& body) const {
  const auto place = static_cast<std::size_t>(body.getWorldArrayIndex());
  if (place >= by_place_.size()) return nullptr;
  Piece* piece = by_place_[place];
  return piece && &piece->body() == &body ? piece : nullptr;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
