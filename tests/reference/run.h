#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/operators/time_operator.h"
#include "tests/reference/readings.h"

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

  // On all points as they are and move, N; moves nothing.
  std::vector<Vec3> forces();

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

}  // namespace limber::reference
