#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/face_contact.h"
#include "core/contact/passive_contact.h"
#include "core/dynamics/lattice.h"

namespace limber {

// Contact within cells: what bears a load when springs are crushed flat. Springs push along
// themselves, and least so when a cell is about to be turned inside out: beyond that they hold it
// there. Here each corner of a cell stays behind each of the cell's faces that it is not part of,
// with some room: stopped by a contact force along the face's normal, opposite on the face at the
// corner's foot. Momentum and angular momentum are kept, and no contact gives back more energy than
// it took. It has no spring: the stable step stays what it was.
//
// Which side is which is in the cell's shape as added: one that is found inside out is eased back.
// Cells that have broken, and those without volume, have no inside.
//
// What is strained next to nothing costs a look at its springs every few substeps.
class CellContacts {
 public:
  // `topology_changed`: something broke, or other points are dynamic, or objects were added.
  void refresh(const Lattice& lattice, bool topology_changed);

  // Goes on with the contacts of the other too, which are of other cells.
  void take_over(CellContacts&& other);

  // lattice.force has to hold all other forces that are known.
  void add_forces(Lattice& lattice, double dt);

  // Pairs of a corner and a face that are looked at in every substep.
  std::size_t watched() const { return held_.size(); }

 private:
  struct Held {
    std::int32_t cell, face, point;
    double rest_height;  // m, of the point behind the face in the shape as added
    double offset;       // m of depth that was there when it was first seen
    FaceContact contact;
    PassiveContact books;
  };

  void look(const Lattice& lattice);
  void find_strained_cells(const Lattice& lattice);
  void hold_what_is_low(const Lattice& lattice, std::int32_t cell, std::span<const Held> before);
  void push(Lattice& lattice, Held& held, double dt) const;

  IndexRows points_;                       // cell -> its corners
  std::vector<std::int32_t> strained_;     // cells
  std::vector<std::uint8_t> is_strained_;  // shape (C)
  std::vector<Held> held_;                 // ascending by cell
  int until_look_ = 0;                     // substeps
};

}  // namespace limber
