#pragma once

#include <span>
#include <string>

#include "core/operators/time_operator.h"

namespace limber {

// One way to integrate, and how long a step it bears.
struct Scheme {
  const char* name;
  Integrator integrator;
  SpringPrecision precision;
  double (*step_limit)(double omega_rad_s, double damping_ratio);  // s; infinite: any step
  int steps = 512;  // of a case: what takes long to grow has to be seen
};

// Those of the atlas: one line each.
std::span<const Scheme> schemes();

enum class StabilityModel {
  kOscillator,  // two points
  kChain,       // eight points in a row
  kBlock,       // 4 x 4 x 4 points, each joined to its 26 neighbours
};

// What was done to the shape before the start.
enum class ShapeDefect {
  kNone,         // at rest but for a thousandth of the spacing
  kInsideOut,    // half as long and mirrored: every cell has a negative volume
  kOneInverted,  // a corner pushed through its cell
  kFlat,         // no thickness: cells without volume, points on top of one another
  kCoincident,   // two neighbours in one place
  kOnePlace,     // all points in one place
};

enum class Motion {
  kTranslation,
  kSpin,     // about the centre, `speed` at the farthest point
  kScatter,  // each point in a direction of its own
};

enum class StepChoice {
  kShare,      // of the analytic limit; where that is 0 or infinite, of 2 / omega
  kSeconds,    // as it is
  kAutomatic,  // TimeOperator::largest_step()
};

struct StabilityCase {
  const char* sweep = "";
  Scheme scheme = {};
  StabilityModel model = StabilityModel::kBlock;
  double stiffness = 1e4;      // N/m, of every spring; points weigh 1 kg
  double damping_ratio = 0.0;  // at the highest frequency, damping proportional to stiffness
  double mass_ratio = 1.0;     // every second point weighs so many kg
  double size = 1.0;           // m, along each axis with more than one point
  double place = 0.0;          // m from the origin, along x
  double speed = 0.0;          // m/s
  Motion motion = Motion::kTranslation;
  ShapeDefect defect = ShapeDefect::kNone;
  bool contacts = false;  // between points of the object; of no effect at small strain
  StepChoice choice = StepChoice::kShare;
  double step = 1.0;       // share or s
  int steps_per_tick = 1;  // in one call of TimeOperator::advance
  bool in_range = true;    // of the atlas; beyond, only crashes, hangs and NaN count
};

enum class StabilityOutcome {
  kStable,   // finite, and no more energy at the end than at the start
  kGrew,     // finite, with more energy
  kStopped,  // SimulationError
  kRefused,  // InputError
  kFailed,   // anything else that was thrown
};
const char* name_of(StabilityOutcome outcome);

struct StabilityResult {
  StabilityCase tried;
  StabilityOutcome outcome = StabilityOutcome::kStable;
  double limit = 0.0;     // s, analytic: of small vibrations, or at any strain for what starts far
                          // from its rest shape or moves within itself
  double step = 0.0;      // s, as taken
  double growth = 0.0;    // of the energy, see kTolerableGrowth
  std::string message;    // of what stopped or refused it
  std::string violation;  // of the rule below; empty: none
};

// Integrates one case. The rule for each: it ends with finite positions and velocities, or with an
// error that names the body, what happened and the remedy; at 0.9 of the analytic limit and below
// it does not stop, and small vibrations do not grow. Energy is that of motion about the centre of
// mass and of the springs.
StabilityResult try_case(const StabilityCase& tried);

// The model of a case at its start. Throws InputError for what makes none.
PhysicalModel stability_model(const StabilityCase& tried);

// Is it in the range of small vibrations about the rest shape?
bool vibrates_little(const StabilityCase& tried);

// The analytic limit of a case, s, and the step that it asks for.
double analytic_step_limit(const StabilityCase& tried);

// Growth is the largest energy in the last quarter of the steps over the largest in the first
// quarter, or over kMostSwing times that at the start. Below this it counts as none: the energies
// of many modes together are never sampled at their peak.
inline constexpr double kTolerableGrowth = 2.0;

// At a share s of the limit the energy of semi-implicit Euler swings by (1 + s) / (1 - s).
inline constexpr double kMostSwing = 200.0;

// Below this share of the limit nothing may stop.
inline constexpr double kSafeShare = 0.9;

}  // namespace limber
