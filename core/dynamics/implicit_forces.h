#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/dynamics/implicit_system.h"

namespace limber {

// J. No step may raise the sum.
struct StepEnergy {
  double kinetic = 0.0;   // of velocities against the centre of mass
  double drift = 0.0;     // kinetic, of the centre of mass
  double elastic = 0.0;   // of the springs
  double outside = 0.0;   // of supports and constant forces: 0 at the start
  double rounding = 0.0;  // of springs, by the last digits of positions; not in the sum

  double sum() const { return kinetic + drift + elastic + outside; }
  double scale() const { return kinetic + drift + elastic; }
};

// The forces on the rows of an ImplicitSystem while a step looks for its end: springs follow the
// points, supports do so linearly, everything else stays as it was at first.
class ImplicitForces {
 public:
  // Splits lattice.force, which has to be that of the points' present motion.
  ImplicitForces(const Lattice& lattice, const ImplicitSystem& system,
                 std::span<const PointSupport> supports);

  // A step of dt (s) starts from the points' present motion. The first one starts where
  // lattice.force was taken; the forces from outside remain those.
  void start_step(const Lattice& lattice, double dt);
  double dt() const { return dt_; }
  const std::vector<PointMotion>& start() const { return start_; }       // of the rows
  const std::vector<double>& start_lengths() const { return lengths_; }  // m, of the springs

  // How far the present motion is from the end of the step, N s: dt F(x, v) - M (v - v_start), zero
  // when found.
  Eigen::VectorXd remaining_impulse(const Lattice& lattice) const;

  // The function of the end's velocities whose gradient is minus remaining_impulse(), J:
  // 1/2 |v - v_start|_M^2 plus all potentials.
  double merit(const Lattice& lattice) const;

  // Of neither springs nor, once a point moved, supports, N.
  const Eigen::VectorXd& constant() const { return constant_; }

  StepEnergy energy(const Lattice& lattice) const;

 private:
  Vec3 moved(const Lattice& lattice, std::int32_t row) const;  // since the first start, m
  double outside(const Lattice& lattice) const;
  void add_supports(const Lattice& lattice, Eigen::VectorXd& impulse) const;
  void add_kinetic(const Lattice& lattice, StepEnergy& energy) const;
  void add_elastic(const Lattice& lattice, StepEnergy& energy) const;

  const ImplicitSystem& system_;
  std::vector<PointSupport> supports_;  // of rows
  Eigen::VectorXd constant_;            // N
  std::vector<PointMotion> first_, start_;
  std::vector<double> lengths_;
  double dt_ = 0.0;
};

// The motion of the rows.
std::vector<PointMotion> motion_of(const Lattice& lattice, const ImplicitSystem& system);

}  // namespace limber
