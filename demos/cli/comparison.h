#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "demos/scenes/simulation.h"

// What `limber compare` computes from finished runs. Pure functions: numbers in, numbers out;
// nothing here knows the command line. Nothing means "not measured" and is never replaced by 0.
namespace limber::demos {

// How far two runs of one scene lie apart.
struct Errors {
  // Largest distance of the two centres of mass of an object, over the objects and the ticks up to
  // the first break of either run (without a break, to the end), per object size. After the first
  // break "the" centre of an object is no longer one thing.
  std::optional<double> com_rel;
  // Likewise the angle between the two orientations, rad, 0 to pi.
  std::optional<double> rotation_rad;
  // Sum of the differences of the k-th heaviest pieces of both runs, k = 1, 2, ..., per total mass;
  // where one run has fewer pieces, against 0. A piece has at least one edge; debris is none. 0 for
  // equal pieces, at most 2.
  std::optional<double> fragment_mass_l1;
};

// The angle of the rotation that leads from a to b, rad, 0 to pi. Exact to rounding at both ends,
// where the arc cosine of the trace loses half of the digits.
double angle_between(const Mat3& a, const Mat3& b);

// Sum of |a_k - b_k| over both lists in descending order; the shorter one goes on with zeros.
double sorted_l1(std::vector<double> a, std::vector<double> b);

Errors errors_between(const RunResult& a, const RunResult& b);

// Per number the mean over those that have it.
Errors mean(std::span<const Errors> errors);

// The noise floor: the mean over all pairs i < j of one and the same method at different steps.
Errors noise_of(std::span<const RunResult> runs);

// The error above that floor is the mean over all pairs i != j. The pairs with i = j are left out:
// they share their step and so part of their noise, which would make the error look smaller than
// what it is compared with. With a single pair of runs there is only that pair.
Errors error_of(std::span<const RunResult> flexible, std::span<const RunResult> switching);

// Pieces that matter to the eye: over 0.5 % of the mass.
inline constexpr double kLeastPiece = 0.005;  // of the total mass
std::size_t count_pieces(const RunResult& run);

// The worse, that is the larger, value of the two runs, per total mass.
std::optional<double> largest_piece_rel(const RunResult& a, const RunResult& b);
std::optional<double> debris_rel(const RunResult& a, const RunResult& b);

// The same scene run all-flexible and switching, in the same order of steps; [0] is at the
// automatically chosen step and the pair that is shown.
struct ComparedRuns {
  std::vector<RunResult> flexible;
  std::vector<RunResult> switching;
  std::optional<double> spring_rate;  // updates/s of the micro-benchmark on the same lattice
};

// The factor on the automatic substep of the k-th run: 1, 0.99, 0.98, ... Smaller steps only:
// larger ones would leave the bound of stability.
inline constexpr double kStepDifference = 0.01;
double step_scale(std::size_t k);

struct Comparison {
  std::optional<double> speedup;         // wall time flexible / switching, of the pair shown
  std::optional<double> median_speedup;  // of the median wall times, with several runs
  std::optional<double> update_ratio;    // spring updates flexible / switching
  std::optional<double> baseline_efficiency;
  Errors error;
  std::optional<Errors> noise;
};

Comparison compare(const ComparedRuns& runs);

// The middle value; of an even number the mean of the two in the middle. At least one is needed.
double median(std::vector<double> values);
double median_wall_s(std::span<const RunResult> runs);

}  // namespace limber::demos
