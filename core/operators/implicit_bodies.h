#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/implicit_euler.h"
#include "core/dynamics/lattice.h"

namespace limber {

// The objects that go by implicit Euler, and what is left for the explicit method.
class ImplicitBodies {
 public:
  // Takes effect with the next step.
  void add(std::size_t object);
  bool contains(std::size_t object) const { return object < implicit_.size() && implicit_[object]; }

  // To be told after rebuild_active(), and of edges that broke.
  void roles_changed() { stale_ = true; }
  void edges_broken(const Lattice& lattice, std::span<const std::int32_t> edges);

  // Dynamic points of these objects and of the others.
  std::span<const std::int32_t> implicit_points(const Lattice& lattice);
  std::span<const std::int32_t> explicit_points(const Lattice& lattice);

  // Moves the dynamic points of these objects on by dt (s) under lattice.force; supports ascending
  // by point.
  void step(Lattice& lattice, double dt, std::span<const PointSupport> supports);

 private:
  struct Body {
    std::size_t first = 0, count = 0;  // of implicit_points_
    ImplicitEuler method;
  };

  void refresh(const Lattice& lattice);

  std::vector<bool> implicit_;  // shape (objects that were added)
  std::vector<Body> bodies_;    // shape (objects), without points for explicit ones
  std::vector<std::int32_t> implicit_points_, explicit_points_;  // ascending
  bool any_ = false;
  bool stale_ = true;
};

}  // namespace limber
