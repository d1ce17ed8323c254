#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/implicit_system.h"
#include "core/dynamics/lattice.h"
#include "core/environment/ground.h"

namespace limber {

// What the ground did to the points.
struct GroundReport {
  Vec3 impulse = Vec3::Zero();  // N s
  double friction_J = 0.0;      // energy that friction took
  double impact_J = 0.0;        // energy that a hard ground took
};

// The dynamic points of a lattice on the ground. Normal forces belong to the sum of forces;
// friction and a hard ground act on velocities when the step is done, as impulses: sticking is
// exact and has no say in the size of the step.
class GroundContact {
 public:
  // Before the first step: points that touch a hard ground and move into it are stopped at once.
  void stop_what_enters(Lattice& lattice, const Ground& ground, GroundReport& report);

  // Adds the penalty of each of these points below the surface; of a hard ground, what it takes to
  // keep the points that lie on it from moving in. `weight`: the share of this evaluation in the
  // step.
  void add_forces(Lattice& lattice, const Ground& ground, std::span<const std::int32_t> points,
                  double weight);

  // The same for points that go by implicit Euler, which follows the penalty through the step, so
  // that its stiffness does not bound dt (s): adds the force of the start and returns what supports
  // them, in their order. A point that leaves within the step under the other forces is let go;
  // all of these have to be in lattice.force.
  std::span<const PointSupport> support(Lattice& lattice, const Ground& ground,
                                        std::span<const std::int32_t> points, double dt);

  // Ends a step of dt (s): stops what entered a hard ground, then friction, per point: at rest it
  // stays so up to mu_s N dt, else it loses up to mu_k N dt. `moved_share`: how far a change of
  // velocity in this step moves a point, as a share of dt.
  void finish_step(Lattice& lattice, const Ground& ground, double dt, double moved_share,
                   GroundReport& report);

 private:
  void resize(std::size_t points);
  void book_supports(const Lattice& lattice, const Ground& ground);
  double stop_at_surface(Lattice& lattice, const Ground& ground, std::int32_t p,
                         GroundReport& report);
  void rub(Lattice& lattice, const Ground& ground, std::int32_t p, double normal_impulse,
           double moved_by, GroundReport& report);

  std::vector<double> normal_force_;  // shape (P), N, mean over the step so far
  std::vector<std::uint8_t> held_;    // shape (P): lies on a hard ground
  std::vector<std::uint8_t> stuck_;   // shape (P): static friction holds it
  std::vector<PointSupport> supports_;
};

}  // namespace limber
