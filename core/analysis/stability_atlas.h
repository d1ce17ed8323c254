#pragma once

#include <functional>
#include <vector>

#include "core/analysis/stability_case.h"

namespace limber {

// Where the integrators hold: docs/stability.md.

enum class AtlasExtent { kFast, kFull };

// A limit as measured beside the analytic one, against the damping ratio or the mass ratio.
struct LimitSample {
  Scheme scheme;
  double at = 0.0;        // the ratio
  double analytic = 0.0;  // omega dt, with omega the highest frequency; 0: never stable
  double measured = 0.0;  // omega dt
};

// How an undamped oscillator is integrated.
struct FrequencySample {
  Scheme scheme;
  double omega_step = 0.0;
  double frequency_error = 0.0;  // of the frequency, relative; measured
  double factor = 1.0;           // of the amplitude, per step; measured
};

struct StabilityAtlas {
  std::vector<StabilityResult> cases;
  std::vector<LimitSample> damping;     // of an oscillator
  std::vector<LimitSample> mass_ratio;  // of a chain
  std::vector<FrequencySample> frequency;
};

// Told the share that is done, 0 to 1.
using AtlasProgress = std::function<void(double share)>;

// All cases of the atlas, in the order in which they are tried.
std::vector<StabilityCase> atlas_cases(AtlasExtent extent);

// Tries them all. The same numbers every time; the full atlas takes about a minute.
StabilityAtlas make_stability_atlas(AtlasExtent extent, const AtlasProgress& progress = {});

// What the map of the atlas was drawn with.
inline constexpr double kMapDampingRatio = 0.1;
inline constexpr const char* kMapSweep = "stiffness and tick";

}  // namespace limber
