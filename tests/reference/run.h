#pragma once

#include <functional>
#include <memory>
#include <numeric>
#include <vector>

#include "core/operators/time_operator.h"

namespace limber::reference {

// One model in one environment, stepped by the library's time operator.
class Run {
 public:
  explicit Run(PhysicalModel model, Environment environment = {},
               Integrator integrator = Integrator::kRungeKutta4);
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  Lattice& lattice() { return lattice_; }
  const Lattice& lattice() const { return lattice_; }
  double time() const { return operator_->time(); }

  // Largest step of symplectic Euler that is stable with springs, dampers and a soft ground, s.
  double stable_step() const { return stable_step_; }

  StepReport step(double dt);

  // Steps of at most `largest_step` that end at `time` exactly; `after_step` looks at each.
  void advance_to(double time, double largest_step, const std::function<void()>& after_step = {});

  // One step of dt, or shorter: to the moment when `happened` turns true, found by trying shorter
  // steps. It has to be false before. Returns whether it happened. Not for models that break.
  bool step_until(const std::function<bool()>& happened, double dt);

 private:
  double moment_of(const std::function<bool()>& happened, double dt);
  bool would_happen(const std::function<bool()>& happened, double dt);

  Lattice lattice_;
  Environment environment_;
  std::unique_ptr<TimeOperator> operator_;
  double stable_step_ = 0.0;
  std::vector<PointMotion> start_;
};

// Readings of a lattice.
std::vector<std::int32_t> all_points(const Lattice& lattice);
std::vector<std::int32_t> free_points(const Lattice& lattice);  // not pinned
RigidMotion rigid_motion(const Lattice& lattice);               // of all points
double kinetic_energy(const Lattice& lattice);                  // J
double elastic_energy(const Lattice& lattice);                  // J
double energy(const Lattice& lattice);                          // kinetic and elastic, J
double energy_about_centre(const Lattice& lattice);             // without that of the centre, J
double stretch(const Lattice& lattice, std::size_t edge);       // L - L0, m
double stretch_rate(const Lattice& lattice, std::size_t edge);  // m/s
double largest_stretch(const Lattice& lattice);  // over the unbroken edges, either way, m

}  // namespace limber::reference
