#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/dynamics/lattice.h"
#include "core/dynamics/quanta.h"
#include "core/dynamics/regular_grid.h"
#include "core/dynamics/stencil_kernel.h"

namespace limber {

// The springs of one regular grid of a lattice, in the form that vector instructions like: the fast
// path of spring_forces.h. Motion stays in the lattice in double precision; here are copies of it,
// made anew for every sum of forces: positions as whole quanta, velocities in single precision
// relative to one of the points.
class StencilSprings {
 public:
  // Can single precision hold it? See fits_single_precision().
  static bool can_hold(const RegularGrid& grid);

  // `grid` is of the object's authored model.
  StencilSprings(const LatticeObject& object, const RegularGrid& grid);

  // Edges of the lattice, in the order that remove() counts by.
  std::size_t springs() const { return springs_.size(); }
  std::int32_t edge(std::size_t spring) const { return springs_[spring].edge; }

  // Takes the lattice's active springs; to be called after rebuild_active().
  void rebuild(const Lattice& lattice);

  // The spring broke.
  void remove(std::size_t spring);

  // Blocks of cells with springs. Any two calls for different ranges may run at the same time.
  std::size_t blocks() const { return blocks_.size(); }

  // First choose_origin(), then read_motion() for all blocks, then add_forces(). read_motion()
  // returns the largest component of a velocity, quanta/s: where Quanta::may_wrap() by it,
  // require_measurable() comes next.
  void choose_origin(const Lattice& lattice);
  double read_motion(const Lattice& lattice, std::size_t from, std::size_t to);
  void require_measurable(const Lattice& lattice) const;

  // Adds to lattice.force of the points of these blocks. Appends the edges at these points that
  // passed a threshold, by the lattice's own double precision. Throws SimulationError for a spring
  // too long for single precision.
  void add_forces(Lattice& lattice, std::size_t from, std::size_t to,
                  std::vector<std::int32_t>& overstretched_edges);

 private:
  struct Spring {
    std::int32_t edge;    // of the lattice
    std::int32_t cell;    // of its first end
    std::uint8_t half;    // see GridSpring
    std::uint8_t number;  // class, 1 to 15
  };

  void set_constants(const RegularGrid& grid);
  void set_class(std::int32_t cell, int half, std::uint32_t number);
  std::int32_t other_cell(const Spring& spring) const;
  StencilView view();
  template <class Body>
  void for_each_point(std::size_t from, std::size_t to, const Body& body) const;
  bool has(std::int32_t edge) const;
  void look_at(const Lattice& lattice, std::int32_t point,
               std::vector<std::int32_t>& overstretched_edges) const;

  Quanta quanta_;
  std::int32_t guard_;               // cells before the first, so that every neighbour exists
  std::vector<std::int32_t> point_;  // shape (cells): of the lattice, or -1
  std::vector<Spring> springs_;
  std::array<StencilConstants, kGridDirections> constants_;
  bool crush_ = false;

  // Shape (guard + cells + guard)
  std::array<std::vector<std::int32_t>, 3> position_;
  std::array<std::vector<float>, 3> velocity_;
  std::array<std::vector<float>, 3> force_;
  std::array<std::vector<std::uint32_t>, 4> classes_;

  std::vector<std::int32_t> blocks_;          // first cell of each
  std::vector<std::uint16_t> overstretched_;  // shape (blocks)
  std::int32_t origin_point_ = -1;            // an end of an active spring
  PointMotion origin_;
};

}  // namespace limber
