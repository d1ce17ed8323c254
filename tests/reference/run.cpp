#include "tests/reference/run.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/vibration.h"
#include "core/dynamics/stable_step.h"

namespace limber::reference {
namespace {

double largest_damping_time(const PhysicalModel& model) {
  double time = 0.0;  // s, c / k
  for (const EdgeAttributes& edge : model.edges) {
    if (edge.stiffness > 0.0) time = std::max(time, edge.damping / edge.stiffness);
  }
  return time;
}

double lightest(const PhysicalModel& model) {
  double mass = kUnbreakable;
  for (const PointAttributes& point : model.points) mass = std::min(mass, point.mass);
  return mass;
}

double stable_step_of(const PhysicalModel& model, const Environment& environment) {
  double omega = model.edges.empty() ? 0.0 : exact_highest_frequency(model);
  const double zeta = 0.5 * largest_damping_time(model) * omega;
  if (environment.ground && std::isfinite(environment.ground->stiffness)) {
    omega = std::hypot(omega, std::sqrt(environment.ground->stiffness / lightest(model)));
  }
  return omega > 0.0 ? stable_step(omega, zeta) : kUnbreakable;
}

}  // namespace

Run::Run(PhysicalModel model, Environment environment, Integrator integrator)
    : environment_(std::move(environment)) {
  require_valid(environment_);
  stable_step_ = stable_step_of(model, environment_);
  add_object(lattice_, std::move(model));
  rebuild_active(lattice_);
  operator_ = std::make_unique<TimeOperator>(lattice_, integrator);
}

StepReport Run::step(double dt) { return operator_->advance(1, dt, environment_); }

// Those that a step begins with, so short a one that no digit changes but that of a point at rest.
std::vector<Vec3> Run::forces() {
  constexpr double kNoTime = 1e-100;  // s
  start_ = lattice_.motion;
  TimeOperator(lattice_, Integrator::kSymplecticEuler).advance(1, kNoTime, environment_);
  lattice_.motion = start_;
  return lattice_.force;
}

void Run::advance_to(double time, double largest_step, const std::function<void()>& after_step) {
  const double start = operator_->time();
  const auto steps = static_cast<int>(std::ceil((time - start) / largest_step - 1e-9));
  if (steps <= 0) return;
  const double dt = (time - start) / steps;
  for (int i = 0; i < steps; ++i) {
    step(dt);
    if (after_step) after_step();
  }
  operator_->set_time(time);
}

bool Run::step_until(const std::function<bool()>& happened, double dt) {
  start_ = lattice_.motion;
  TimeOperator before = *operator_;
  step(dt);
  if (!happened()) return false;
  lattice_.motion = start_;
  operator_ = std::make_unique<TimeOperator>(before);
  step(moment_of(happened, dt));
  return true;
}

// A copy of the operator takes the trial step: what it remembers from step to step stays as it is.
bool Run::would_happen(const std::function<bool()>& happened, double dt) {
  TimeOperator trial = *operator_;
  trial.advance(1, dt, environment_);
  const bool result = happened();
  lattice_.motion = start_;
  return result;
}

double Run::moment_of(const std::function<bool()>& happened, double dt) {
  double before = 0.0, after = dt;
  while (after - before > 1e-12 * dt) {
    const double middle = 0.5 * (before + after);
    (would_happen(happened, middle) ? after : before) = middle;
  }
  return after;
}

}  // namespace limber::reference
