#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/components.h"
#include "core/dynamics/lattice.h"
#include "core/model/bounds.h"

namespace limber {

// Of each point the piece it belongs to, or behind all of those the rigid body that carries it.
Components with_carriers(const Lattice& lattice, const Components& pieces);

// Boxes around pieces, and which of them may meet: they overlap, and at least one of the two is
// flexible. What two rigid bodies do to each other is their own engine's business.
class PieceBoxes {
 public:
  // Boxes go around `points` and reach `by` (m) further.
  PieceBoxes(const Lattice& lattice, std::span<const std::int32_t> points, const Components& pieces,
             double by);

  // Does this box, of `piece`, touch that of another piece it may meet?
  bool reaches_into_another(const Box3& box, std::int32_t piece) const;

  // Where there are so many pieces that to compare them costs more than it saves, as in a heap of
  // grains, it is better to do without.
  static bool pay(std::int32_t pieces, std::size_t points);

 private:
  std::vector<Box3> boxes_;
  std::vector<std::vector<std::int32_t>> others_;  // shape (pieces): whom each may meet
};

}  // namespace limber
