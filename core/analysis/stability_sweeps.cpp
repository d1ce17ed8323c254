#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analysis/stability_atlas.h"

// The cases of the atlas, sweep by sweep.

namespace limber {
namespace {

using Cases = std::vector<StabilityCase>;
using Values = std::vector<double>;

// Full atlas, or its fast subset.
template <class T>
T by_extent(AtlasExtent extent, T full, T fast) {
  return extent == AtlasExtent::kFull ? full : fast;
}

// From 10^from to 10^to, both included.
Values decades(double from, double to, double per_decade) {
  Values values;
  const auto count = static_cast<int>(std::lround((to - from) * per_decade));
  for (int i = 0; i <= count; ++i) values.push_back(std::pow(10.0, from + i / per_decade));
  return values;
}

// Blocks are tried a tick of several steps at a time, as programs do.
StabilityCase case_of(const char* sweep, const Scheme& scheme, StabilityModel model) {
  StabilityCase one;
  one.sweep = sweep;
  one.scheme = scheme;
  one.model = model;
  one.steps_per_tick = model == StabilityModel::kBlock ? 4 : 1;
  return one;
}

void add_shares(Cases& cases, const StabilityCase& base, const Values& shares) {
  for (double share : shares) {
    cases.push_back(base);
    cases.back().choice = StepChoice::kShare;
    cases.back().step = share;
  }
}

void add_damping(Cases& cases, const Scheme& scheme, AtlasExtent extent) {
  for (auto model : {StabilityModel::kOscillator, StabilityModel::kChain, StabilityModel::kBlock}) {
    for (double zeta : by_extent<Values>(extent, {0.0, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0},
                                         {0.0, 0.1, 100.0})) {
      StabilityCase one = case_of("damping ratio", scheme, model);
      one.damping_ratio = zeta;
      add_shares(cases, one, {0.5, 0.9, 1.1, 3.0, 100.0});
    }
  }
}

void add_map(Cases& cases, const Scheme& scheme, AtlasExtent extent) {
  const double per_decade = by_extent(extent, 2.0, 0.5);
  for (double stiffness : decades(-2.0, 12.0, per_decade)) {
    for (double tick : decades(-5.0, -1.0, 2.0 * per_decade)) {
      StabilityCase one = case_of(kMapSweep, scheme, StabilityModel::kBlock);
      one.stiffness = stiffness;
      one.damping_ratio = kMapDampingRatio;
      one.choice = StepChoice::kSeconds;
      one.step = tick;
      cases.push_back(one);
    }
  }
}

void add_mass_ratios(Cases& cases, const Scheme& scheme, AtlasExtent extent) {
  for (auto model : {StabilityModel::kChain, StabilityModel::kBlock}) {
    for (double ratio : decades(-6.0, 6.0, by_extent(extent, 1.0, 1.0 / 6.0))) {
      StabilityCase one = case_of("mass ratio", scheme, model);
      one.mass_ratio = ratio;
      one.damping_ratio = 0.1;
      add_shares(cases, one, {0.5, 0.9, 3.0});
    }
  }
}

void add_places(Cases& cases, const Scheme& scheme, AtlasExtent extent) {
  for (double size : decades(-3.0, 3.0, by_extent(extent, 1.0, 1.0 / 3.0))) {
    for (double place : by_extent<Values>(extent, {0.0, 1e2, 1e4, 1e6, 1e7}, {0.0, 1e7})) {
      for (double speed : by_extent<Values>(extent, {0.0, 1.0, 30.0, 1000.0}, {1000.0})) {
        StabilityCase one = case_of("size, place and speed", scheme, StabilityModel::kBlock);
        one.size = size;
        one.place = place;
        one.speed = speed;
        one.damping_ratio = 0.05;
        add_shares(cases, one, {0.9});
      }
    }
  }
}

// Shares of the analytic limit without contacts, and what a user gets who does not ask: contacts
// and the automatic step, which is that of semi-implicit Euler.
void add_violent(Cases& cases, StabilityCase one, const Values& shares) {
  one.steps_per_tick = std::min(64, one.scheme.steps);
  for (bool contacts : {false, true}) {
    one.contacts = contacts;
    add_shares(cases, one, shares);
  }
  if (one.scheme.integrator != Integrator::kSymplecticEuler) return;
  one.choice = StepChoice::kAutomatic;
  one.step = 1.0;
  cases.push_back(one);
}

void add_defects(Cases& cases, const Scheme& scheme, AtlasExtent extent) {
  for (auto model : {StabilityModel::kOscillator, StabilityModel::kBlock}) {
    for (auto defect : {ShapeDefect::kInsideOut, ShapeDefect::kOneInverted, ShapeDefect::kFlat,
                        ShapeDefect::kCoincident, ShapeDefect::kOnePlace}) {
      for (double stiffness : by_extent<Values>(extent, {1e-2, 1e4, 1e12}, {1e4})) {
        for (double zeta : by_extent<Values>(extent, {0.0, 0.1, 10.0}, {0.1})) {
          StabilityCase one = case_of("defect", scheme, model);
          one.defect = defect;
          one.stiffness = stiffness;
          one.damping_ratio = zeta;
          add_violent(cases, one, {0.5, 0.9, 2.0, 100.0});
        }
      }
    }
  }
}

void add_motions(Cases& cases, const Scheme& scheme, AtlasExtent extent) {
  for (auto motion : {Motion::kSpin, Motion::kScatter}) {
    for (double speed : by_extent<Values>(extent, {1.0, 30.0, 1000.0}, {1000.0})) {
      for (double stiffness : by_extent<Values>(extent, {1e-2, 1e4, 1e12}, {1e4})) {
        StabilityCase one = case_of("motion within", scheme, StabilityModel::kBlock);
        one.motion = motion;
        one.speed = speed;
        one.stiffness = stiffness;
        add_violent(cases, one, {0.5, 0.9, 2.0});
      }
    }
  }
}

// Numbers that no simulation can begin with, and some at the end of all numbers.
void add_bad_inputs(Cases& cases, const Scheme& scheme, AtlasExtent) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  StabilityCase base = case_of("bad input", scheme, StabilityModel::kBlock);
  base.in_range = false;
  const auto add = [&](double StabilityCase::*number, const Values& values) {
    for (double value : values) {
      cases.push_back(base);
      cases.back().*number = value;
      if (number == &StabilityCase::step) cases.back().choice = StepChoice::kSeconds;
    }
  };
  add(&StabilityCase::stiffness, {kNan, kInf, -1.0, 1e300, 1e307, 1e-300});
  add(&StabilityCase::damping_ratio, {kNan, kInf, -1.0, 1e300});
  add(&StabilityCase::mass_ratio, {kNan, kInf, -1.0, 0.0, 1e-300, 1e300});
  add(&StabilityCase::size, {kNan, kInf, -1.0, 0.0, 1e-300, 1e300});
  add(&StabilityCase::place, {kNan, kInf, 1e17, 1e300});
  add(&StabilityCase::speed, {kInf, 1e17, 1e300});
  add(&StabilityCase::step, {kNan, kInf, -1.0, 0.0, 1e-300, 1e300});
}

}  // namespace

std::vector<StabilityCase> atlas_cases(AtlasExtent extent) {
  Cases cases;
  for (const Scheme& scheme : schemes()) {
    for (auto add : {add_damping, add_map, add_mass_ratios, add_places, add_defects, add_motions,
                     add_bad_inputs}) {
      add(cases, scheme, extent);
    }
  }
  return cases;
}

}  // namespace limber
