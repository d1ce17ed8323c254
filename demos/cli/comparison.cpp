#include "demos/cli/comparison.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

namespace limber::demos {
namespace {

std::optional<double> ratio(double above, double below) {
  const double value = above / below;
  if (below > 0.0 && std::isfinite(value)) return value;
  return std::nullopt;
}

double first_break_of_either(const RunResult& a, const RunResult& b) {
  const double never = std::numeric_limits<double>::infinity();
  return std::min(a.first_break_s.value_or(never), b.first_break_s.value_or(never));
}

struct WorstPose {
  double distance_m = 0.0;
  double angle_rad = 0.0;
  bool measured = false;

  void take(const ObjectSample& a, const ObjectSample& b) {
    distance_m = std::max(distance_m, (a.centre_of_mass - b.centre_of_mass).norm());
    angle_rad = std::max(angle_rad, angle_between(a.rotation, b.rotation));
    measured = true;
  }
};

WorstPose worst_pose(const RunResult& a, const RunResult& b) {
  const double end = first_break_of_either(a, b);
  const std::size_t ticks = std::min(a.samples.size(), b.samples.size());
  WorstPose worst;
  for (std::size_t t = 0; t < ticks && a.samples[t].time_s <= end; ++t) {
    const auto& objects_a = a.samples[t].objects;
    const auto& objects_b = b.samples[t].objects;
    const std::size_t objects = std::min(objects_a.size(), objects_b.size());
    for (std::size_t i = 0; i < objects; ++i) worst.take(objects_a[i], objects_b[i]);
  }
  return worst;
}

using ErrorMember = std::optional<double> Errors::*;

std::optional<double> mean_of(std::span<const Errors> errors, ErrorMember member) {
  double sum = 0.0;
  std::size_t n = 0;
  for (const Errors& e : errors) {
    if (!(e.*member)) continue;
    sum += *(e.*member);
    ++n;
  }
  if (n == 0) return std::nullopt;
  return sum / static_cast<double>(n);
}

std::optional<double> updates_per_second(const RunResult& run) {
  return ratio(static_cast<double>(run.spring_updates), run.wall_s);
}

std::optional<double> efficiency(const RunResult& run, std::optional<double> best_rate) {
  const std::optional<double> rate = updates_per_second(run);
  if (!rate || !best_rate) return std::nullopt;
  return ratio(*rate, *best_rate);
}

}  // namespace

double angle_between(const Mat3& a, const Mat3& b) {
  const Mat3 r = a.transpose() * b;
  // |skew part| = 2 sin(angle), trace = 1 + 2 cos(angle).
  const Vec3 axis(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  return std::atan2(axis.norm(), r.trace() - 1.0);
}

double sorted_l1(std::vector<double> a, std::vector<double> b) {
  const std::size_t n = std::max(a.size(), b.size());
  a.resize(n, 0.0);
  b.resize(n, 0.0);
  std::sort(a.begin(), a.end(), std::greater<>());
  std::sort(b.begin(), b.end(), std::greater<>());
  double sum = 0.0;
  for (std::size_t k = 0; k < n; ++k) sum += std::abs(a[k] - b[k]);
  return sum;
}

Errors errors_between(const RunResult& a, const RunResult& b) {
  Errors errors;
  const WorstPose worst = worst_pose(a, b);
  if (worst.measured) {
    errors.com_rel = ratio(worst.distance_m, std::max(a.object_size_m, b.object_size_m));
    errors.rotation_rad = worst.angle_rad;
  }
  errors.fragment_mass_l1 =
      ratio(sorted_l1(a.piece_masses, b.piece_masses), std::max(a.total_mass, b.total_mass));
  return errors;
}

Errors mean(std::span<const Errors> errors) {
  return {mean_of(errors, &Errors::com_rel), mean_of(errors, &Errors::rotation_rad),
          mean_of(errors, &Errors::fragment_mass_l1)};
}

Errors noise_of(std::span<const RunResult> runs) {
  std::vector<Errors> pairs;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t j = i + 1; j < runs.size(); ++j) {
      pairs.push_back(errors_between(runs[i], runs[j]));
    }
  }
  return mean(pairs);
}

Errors error_of(std::span<const RunResult> flexible, std::span<const RunResult> switching) {
  if (flexible.size() == 1) return errors_between(flexible[0], switching[0]);
  std::vector<Errors> pairs;
  for (std::size_t i = 0; i < flexible.size(); ++i) {
    for (std::size_t j = 0; j < switching.size(); ++j) {
      if (i != j) pairs.push_back(errors_between(flexible[i], switching[j]));
    }
  }
  return mean(pairs);
}

std::size_t count_pieces(const RunResult& run) {
  const double least = kLeastPiece * run.total_mass;
  return static_cast<std::size_t>(std::count_if(run.piece_masses.begin(), run.piece_masses.end(),
                                                [least](double m) { return m > least; }));
}

std::optional<double> largest_piece_rel(const RunResult& a, const RunResult& b) {
  const auto largest = [](const RunResult& r) {
    const auto heaviest = std::max_element(r.piece_masses.begin(), r.piece_masses.end());
    return heaviest == r.piece_masses.end() ? 0.0 : *heaviest;
  };
  return ratio(std::max(largest(a), largest(b)), std::max(a.total_mass, b.total_mass));
}

std::optional<double> debris_rel(const RunResult& a, const RunResult& b) {
  return ratio(std::max(a.debris_mass, b.debris_mass), std::max(a.total_mass, b.total_mass));
}

double step_scale(std::size_t k) { return 1.0 - kStepDifference * static_cast<double>(k); }

double median(std::vector<double> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  if (values.size() % 2 == 1) return values[middle];
  return 0.5 * (values[middle - 1] + values[middle]);
}

double median_wall_s(std::span<const RunResult> runs) {
  std::vector<double> seconds;
  for (const RunResult& run : runs) seconds.push_back(run.wall_s);
  return median(std::move(seconds));
}

Comparison compare(const ComparedRuns& runs) {
  assert(!runs.flexible.empty() && runs.flexible.size() == runs.switching.size());
  const RunResult& flexible = runs.flexible.front();
  const RunResult& switching = runs.switching.front();
  Comparison c;
  c.speedup = ratio(flexible.wall_s, switching.wall_s);
  c.update_ratio = ratio(static_cast<double>(flexible.spring_updates),
                         static_cast<double>(switching.spring_updates));
  c.baseline_efficiency = efficiency(flexible, runs.spring_rate);
  c.error = error_of(runs.flexible, runs.switching);
  if (runs.flexible.size() > 1) {
    c.noise = noise_of(runs.flexible);
    c.median_speedup = ratio(median_wall_s(runs.flexible), median_wall_s(runs.switching));
  }
  return c;
}

}  // namespace limber::demos
