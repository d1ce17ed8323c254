#include "core/analysis/stability_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/analysis/step_limits.h"
#include "core/dynamics/stable_step.h"
#include "core/model/errors.h"

namespace limber {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double step_of(const StabilityCase& tried, double limit, const TimeOperator& time) {
  switch (tried.choice) {
    case StepChoice::kSeconds:
      return tried.step;
    case StepChoice::kAutomatic:
      return tried.step * time.largest_step();
    case StepChoice::kShare:
      break;
  }
  if (limit > 0.0 && limit < kNever) return tried.step * limit;
  StabilityCase undamped = tried;
  undamped.scheme.step_limit = stable_step;
  undamped.damping_ratio = 0.0;
  return tried.step * analytic_step_limit(undamped);
}

Vec3 mean_velocity(const Lattice& lattice) {
  Vec3 momentum = Vec3::Zero();
  double mass = 0.0;
  for (std::size_t p = 0; p < lattice.mass.size(); ++p) {
    momentum += lattice.mass[p] * lattice.motion[p].velocity;
    mass += lattice.mass[p];
  }
  return momentum / mass;
}

// J, without that of the common motion.
double vibration_energy(const Lattice& lattice) {
  const Vec3 common = mean_velocity(lattice);
  double energy = elastic_energy(lattice, lattice.dynamic_points);
  for (std::size_t p = 0; p < lattice.mass.size(); ++p) {
    energy += 0.5 * lattice.mass[p] * (lattice.motion[p].velocity - common).squaredNorm();
  }
  return energy;
}

// What is too large for a number counts as infinite.
double largest(std::span<const double> energies) {
  double most = 0.0;
  for (double e : energies) most = std::isfinite(e) ? std::max(most, e) : kNever;
  return most;
}

double ratio(double later, double earlier) {
  if (later == kNever) return kNever;
  return later == 0.0 ? 0.0 : later / earlier;
}

// Against the first quarter, in which the swing is the same; against the start, because what grows
// fast has done so by then.
double growth_of(std::span<const double> energies) {
  const std::size_t quarter = std::max<std::size_t>(1, energies.size() / 4);
  const double last = largest(energies.last(quarter));
  return std::max(ratio(last, largest(energies.first(quarter))),
                  ratio(last, energies.front()) / kMostSwing);
}

bool all_finite(const Lattice& lattice) {
  return std::ranges::all_of(lattice.motion, [](const PointMotion& motion) {
    return motion.position.allFinite() && motion.velocity.allFinite();
  });
}

void integrate(const StabilityCase& tried, StabilityResult& result) {
  Lattice lattice;
  add_object(lattice, stability_model(tried));
  rebuild_active(lattice);
  TimeOperator time(lattice, tried.scheme.integrator, tried.scheme.precision);
  result.limit = analytic_step_limit(tried);
  result.step = step_of(tried, result.limit, time);
  std::vector<double> energies = {vibration_energy(lattice)};
  for (int done = 0; done < tried.scheme.steps; done += tried.steps_per_tick) {
    time.advance(tried.steps_per_tick, result.step, kEmptySpace);
    energies.push_back(vibration_energy(lattice));
    if (!all_finite(lattice)) result.violation = "carried on with what is not finite";
  }
  result.growth = growth_of(energies);
  if (result.growth > kTolerableGrowth) result.outcome = StabilityOutcome::kGrew;
}

void note_error(StabilityOutcome outcome, const std::exception& error, StabilityResult& result) {
  result.outcome = outcome;
  result.message = error.what();
  if (outcome == StabilityOutcome::kFailed) result.violation = "threw: " + result.message;
}

void check_diagnostic(const Diagnostic& diagnostic, const std::string& body,
                      StabilityResult& result) {
  const bool whole = !diagnostic.where.empty() && !diagnostic.what.empty() &&
                     !diagnostic.remedy.empty() && diagnostic.where.starts_with(body);
  if (!whole) result.violation = "the message does not name body, cause and remedy";
}

// Contacts are springs that the analytic limit does not know. Single precision stops what is
// stretched beyond its range (require_measurable()), which fast motion does at any step.
bool is_known_limit(const StabilityCase& tried) {
  if (vibrates_little(tried)) return true;
  return !tried.contacts && tried.scheme.precision == SpringPrecision::kDouble;
}

bool is_safe_step(const StabilityResult& result) {
  if (!result.tried.in_range || !(result.step > 0.0) || !is_known_limit(result.tried)) return false;
  constexpr double kRounding = 1.0 + 1e-12;
  return result.step <= kSafeShare * kRounding * result.limit;
}

void judge(StabilityResult& result) {
  if (!result.violation.empty() || !is_safe_step(result)) return;
  if (result.outcome == StabilityOutcome::kStopped) {
    result.violation = "stopped within the analytic limit";
  }
  if (result.outcome == StabilityOutcome::kGrew && vibrates_little(result.tried)) {
    result.violation = "grew within the analytic limit";
  }
}

}  // namespace

std::span<const Scheme> schemes() {
  static constexpr std::array kSchemes = {
      Scheme{"symplectic Euler", Integrator::kSymplecticEuler, SpringPrecision::kDouble,
             stable_step},
      Scheme{"symplectic Euler, single precision", Integrator::kSymplecticEuler,
             SpringPrecision::kSingle, stable_step},
      Scheme{"explicit Euler", Integrator::kExplicitEuler, SpringPrecision::kDouble,
             explicit_euler_step_limit},
      Scheme{"Runge-Kutta 4", Integrator::kRungeKutta4, SpringPrecision::kDouble,
             runge_kutta4_step_limit},
      Scheme{"implicit Euler", Integrator::kImplicitEuler, SpringPrecision::kDouble, no_step_limit,
             32},
  };
  return kSchemes;
}

const char* name_of(StabilityOutcome outcome) {
  constexpr std::array kNames = {"stable", "grew", "stopped", "refused", "failed"};
  return kNames[static_cast<std::size_t>(outcome)];
}

StabilityResult try_case(const StabilityCase& tried) {
  StabilityResult result{.tried = tried, .message = {}, .violation = {}};
  try {
    integrate(tried, result);
  } catch (const SimulationError& error) {
    note_error(StabilityOutcome::kStopped, error, result);
    check_diagnostic(error.diagnostic, stability_model(tried).name, result);
  } catch (const InputError& error) {
    note_error(StabilityOutcome::kRefused, error, result);
    check_diagnostic(error.diagnostic, "", result);
  } catch (const std::exception& error) {
    note_error(StabilityOutcome::kFailed, error, result);
  }
  judge(result);
  return result;
}

}  // namespace limber
