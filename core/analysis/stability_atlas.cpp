#include "core/analysis/stability_atlas.h"

#include <cmath>

#include "core/analysis/oscillator_recurrence.h"
#include "core/analysis/step_limits.h"

namespace limber {
namespace {

// omega dt where a scheme without a limit, or stable at none, is looked at.
constexpr double kNominalStep = 2.0;

double nominal(double limit) { return limit > 0.0 && std::isfinite(limit) ? limit : kNominalStep; }

LimitSample damping_limit(const Scheme& scheme, double zeta) {
  constexpr double kRange = 8.0;
  const double analytic = scheme.step_limit(1.0, zeta), middle = nominal(analytic);
  return {scheme, zeta, analytic,
          measured_step_limit(scheme, zeta, middle / kRange, kRange * middle)};
}

// The largest share of the limit that is stable, by bisection.
double stable_share(StabilityCase tried) {
  constexpr int kHalvings = 13;
  const auto stable = [&](double share) {
    tried.step = share;
    return try_case(tried).outcome == StabilityOutcome::kStable;
  };
  double from = 0.25, to = 4.0;
  if (!stable(from)) return 0.0;
  if (stable(to)) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(from * to);
    (stable(middle) ? from : to) = middle;
  }
  return from;
}

LimitSample mass_ratio_limit(const Scheme& scheme, double mass_ratio) {
  StabilityCase tried;
  tried.scheme = scheme;
  tried.model = StabilityModel::kChain;
  tried.mass_ratio = mass_ratio;
  tried.damping_ratio = 1.0;
  const double analytic = scheme.step_limit(1.0, tried.damping_ratio);
  return {scheme, mass_ratio, analytic, nominal(analytic) * stable_share(tried)};
}

FrequencySample frequency_sample(const Scheme& scheme, double omega_step) {
  const OscillatorRecurrence found = measured_recurrence(scheme, 0.0, omega_step);
  return {scheme, omega_step, found.angle() / omega_step - 1.0, found.largest_factor()};
}

std::vector<double> spaced(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(from * std::pow(to / from, static_cast<double>(i) / (count - 1)));
  }
  return values;
}

// Part of the work that each of the two takes, for the progress.
constexpr double kShareOfCases = 0.97;

}  // namespace

StabilityAtlas make_stability_atlas(AtlasExtent extent, const AtlasProgress& progress) {
  const bool full = extent == AtlasExtent::kFull;
  const std::vector<StabilityCase> cases = atlas_cases(extent);
  StabilityAtlas atlas;
  for (const StabilityCase& one : cases) {
    atlas.cases.push_back(try_case(one));
    const auto done = static_cast<double>(atlas.cases.size());
    if (progress) progress(kShareOfCases * done / static_cast<double>(cases.size()));
  }
  for (const Scheme& scheme : schemes()) {
    for (double zeta : spaced(1e-2, 1e2, full ? 65 : 9)) {
      atlas.damping.push_back(damping_limit(scheme, zeta));
    }
    for (double ratio : spaced(1e-6, 1e6, full ? 25 : 5)) {
      atlas.mass_ratio.push_back(mass_ratio_limit(scheme, ratio));
    }
    for (double step : spaced(1e-2, 10.0, full ? 121 : 13)) {
      atlas.frequency.push_back(frequency_sample(scheme, step));
    }
  }
  if (progress) progress(1.0);
  return atlas;
}

}  // namespace limber
