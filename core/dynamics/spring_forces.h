#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/edge_springs.h"
#include "core/dynamics/lattice.h"
#include "core/dynamics/spring_precision.h"
#include "core/dynamics/stencil_springs.h"

namespace limber {

// The forces of all active springs of a lattice.
class SpringForces {
 public:
  SpringForces(Lattice& lattice, SpringPrecision precision)
      : lattice_(lattice), precision_(precision) {}

  // To be told after rebuild_active(). Looks for grids in objects that are new: better when they
  // are added than when they are hit.
  void active_changed();

  // The springs of this object, an index of lattice.objects, take the scalar path from now on.
  void keep_in_double(std::size_t object);

  // These edges broke; before or after slacken() of lattice.h.
  void remove(std::span<const std::int32_t> broken_edges);

  // Adds to lattice.force. dt, s: the step since the last time. Throws SimulationError for a spring
  // that single precision cannot measure any more.
  void add(double dt);

  // Edges that were past a threshold when the forces were added last, ascending.
  std::span<const std::int32_t> overstretched_edges() const { return overstretched_; }

  // Which path the active springs take that have not broken.
  struct Paths {
    std::size_t grids = 0;   // single precision, owner computes
    std::size_t edges = 0;   // single precision, any topology
    std::size_t scalar = 0;  // double precision
  };
  Paths paths();

 private:
  struct Slot {
    std::int32_t stencil = -1;
    std::int32_t spring = 0;
  };

  // Active springs [from, to).
  struct Run {
    std::size_t from = 0, to = 0;
  };

  void rebuild();
  void find_grids();
  void list_runs();
  void append_runs(std::size_t from, std::size_t to, std::vector<Run>& runs) const;
  void take_edges();
  bool is_in_double(std::size_t object) const {
    return object < in_double_.size() && in_double_[object];
  }
  bool is_on_grid(std::int32_t edge) const { return slot_of_edge_[edge].stencil >= 0; }
  bool is_scalar(std::int32_t edge) const {
    return precision_ == SpringPrecision::kDouble || !(is_on_grid(edge) || edges_.has(edge));
  }
  void add_grid(StencilSprings& stencil, double dt);
  void add_scalar();
  template <bool kMayBreak>
  Vec3 pull_of(std::size_t active, std::vector<std::int32_t>& overstretched) const;
  template <bool kMayBreak>
  void add_in_order(const Run& run);
  template <bool kMayBreak>
  void pull_edges(const Run& run);
  void add_pulls();
  template <class Body>
  void collect(std::size_t count, std::size_t grain, const Body& body);

  Lattice& lattice_;
  SpringPrecision precision_;
  bool stale_ = true;
  std::size_t searched_ = 0;     // objects whose grids are known
  std::vector<bool> in_double_;  // shape (objects that were kept in double)
  std::vector<StencilSprings> stencils_;
  std::vector<Slot> slot_of_edge_;  // shape (E)
  EdgeSprings edges_;
  std::vector<Run> unbreakable_;  // scalar
  std::vector<Run> breakable_;
  std::size_t scalar_ = 0;
  std::vector<Vec3> pulls_;  // shape (A), N: on each active spring's first point, for threads
  // One per range of a parallel loop.
  std::vector<double> fastest_in_;  // quanta/s
  std::vector<std::vector<std::int32_t>> overstretched_in_;
  std::vector<std::int32_t> overstretched_;
};

}  // namespace limber
