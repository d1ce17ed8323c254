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
  // `implicit`: may be undone. Takes effect with the next step.
  void set(std::size_t object, bool implicit);
  bool contains(std::size_t object) const { return object < implicit_.size() && implicit_[object]; }

  // To be told after rebuild_active(), and when springs broke.
  void topology_changed() { stale_ = true; }

  // Dynamic points of the other objects.
  std::span<const std::int32_t> explicit_points(const Lattice& lattice);

  // Moves the dynamic points of these objects on by dt (s) under lattice.force.
  void step(Lattice& lattice, double dt);

 private:
  struct Body {
    std::vector<std::int32_t> points;  // dynamic ones, ascending
    ImplicitEuler method;
  };

  void rebuild(const Lattice& lattice);

  std::vector<bool> implicit_;  // shape (objects that were set)
  std::vector<Body> bodies_;    // shape (objects), without points for explicit ones
  std::vector<std::int32_t> explicit_points_;
  bool any_ = false;
  bool stale_ = true;
};

}  // namespace limber
