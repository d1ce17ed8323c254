#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/dynamics/implicit_forces.h"
#include "core/dynamics/implicit_solver.h"
#include "core/dynamics/implicit_system.h"

namespace limber {

class FactorisedSolver;  // keeps Eigen's sparse solvers out of whoever includes this

struct ImplicitSettings {
  // Newton iterations of one step; 1 is the linearly implicit step.
  int most_newton_iterations = 10;

  // They end when the energy of the remaining error of the forces is less than this share of the
  // energy of motion against the centre of mass plus its square of the elastic energy. 1e-4 means a
  // spring errs by 1 % of the stretch that its motion amounts to, v / omega.
  double newton_tolerance = 1e-4;

  // Where they do not end, or the step would gain energy, it is done as two of half its length, and
  // so on, at most so many times: 5 are 32 parts.
  int most_halvings = 5;

  double solver_tolerance = 1e-6;  // see conjugate_gradients()
  int most_solver_iterations = 5000;

  // Backward Euler slows every rotation, by the share (omega dt)^2 / 2 a step. This gives pieces
  // that nothing holds their whole angular momentum back, as one rotation of the piece.
  bool restore_spin = true;
};

struct ImplicitReport {
  int parts = 0;              // that the step was done in; 1 as a rule
  int newton_iterations = 0;  // of all parts
  int solver_iterations = 0;  // of conjugate gradients, of all; 0: solved by factorisation
  bool converged = true;      // false: a part was as short as it gets, and taken as it was
};

// Backward Euler for the springs, M (v1 - v0) = dt F(x1, v1), x1 = x0 + dt v1, by Newton's method;
// one iteration of it is the linearly implicit step (M + dt C + dt^2 K) dv = dt (F - dt K v0) of
// Baraff and Witkin 1998 ("Large steps in cloth simulation", eq. 6), but about where the piece
// would be as a rigid body, not about where it is: at a linearisation that does not turn with it, a
// stiff body that spins would stretch by (omega dt)^2 / 2, and break. Stable at any step, first
// order, and dissipative: what is faster than the step does not vibrate, it settles.
//
// What is not a spring is explicit: the forces of the start, but for PointSupports. Every iteration
// lowers the step's merit (ImplicitForces) or is shortened until it does. Momentum is kept to the
// last digits, angular momentum as ImplicitSettings::restore_spin says. Results are the same to the
// bit from run to run.
class ImplicitEuler {
 public:
  explicit ImplicitEuler(const ImplicitSettings& settings = {});
  // A copy sets up its own system with its first step.
  ImplicitEuler(const ImplicitEuler& other);
  ImplicitEuler& operator=(const ImplicitEuler& other);
  ImplicitEuler(ImplicitEuler&&) noexcept;
  ImplicitEuler& operator=(ImplicitEuler&&) noexcept;
  ~ImplicitEuler();

  // To be told when springs broke, after rebuild_active(), and for other points.
  void topology_changed() { stale_ = true; }

  // Moves `points` (of one object, dynamic, ascending) on by dt (s) under lattice.force, which has
  // to hold all forces on them at their present motion. Springs to dynamic points that are not
  // among them act explicitly: take whole pieces. Pinned points stay. Throws SimulationError where
  // the linear system cannot be solved or holds what is not finite; motion is undefined then.
  ImplicitReport step(Lattice& lattice, std::span<const std::int32_t> points, double dt,
                      std::span<const PointSupport> supports = {});

 private:
  void rebuild(const Lattice& lattice, std::span<const std::int32_t> points);
  void choose_solver();
  void step_or_halve(Lattice& lattice, ImplicitForces& forces, double dt, int halvings);
  bool try_step(Lattice& lattice, const ImplicitForces& forces);
  void guess(Lattice& lattice, const ImplicitForces& forces) const;
  bool iterate(Lattice& lattice, const ImplicitForces& forces);
  Eigen::VectorXd solve(const Lattice& lattice, const BlockPreconditioner& inverse,
                        const Eigen::VectorXd& impulse);
  void descend(Lattice& lattice, const ImplicitForces& forces, Eigen::VectorXd change) const;
  void move(Lattice& lattice, const ImplicitForces& forces, const Eigen::VectorXd& change) const;
  bool settled(const StepEnergy& energy, double error) const;
  std::vector<std::size_t> unsupported_pieces() const;  // of free_pieces_
  void restore_momenta(Lattice& lattice, const ImplicitForces& forces, double allowed) const;

  ImplicitSettings settings_;
  ImplicitReport report_;
  ImplicitSystem system_;
  std::vector<PointSupport> supports_;
  std::unique_ptr<FactorisedSolver> factorised_;  // null: conjugate gradients
  std::vector<std::vector<std::int32_t>> free_pieces_;
  bool stale_ = true;
};

}  // namespace limber
