#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/analysis/stability_case.h"
#include "core/analysis/step_limits.h"
#include "core/analysis/vibration.h"
#include "core/model/random.h"
#include "core/modeller/cubic_lattice.h"

namespace limber {
namespace {

constexpr double kPerturbation = 1e-3;  // of the spacing: strains well within the linear range

std::array<int, 3> points_of(StabilityModel model) {
  switch (model) {
    case StabilityModel::kOscillator:
      return {2, 1, 1};
    case StabilityModel::kChain:
      return {8, 1, 1};
    case StabilityModel::kBlock:
      break;
  }
  return {4, 4, 4};
}

const char* name_of(StabilityModel model) {
  switch (model) {
    case StabilityModel::kOscillator:
      return "oscillator";
    case StabilityModel::kChain:
      return "chain";
    case StabilityModel::kBlock:
      break;
  }
  return "block";
}

// At rest, undamped, at the origin.
PhysicalModel rest_model(StabilityModel kind, double stiffness, double mass_ratio, double size) {
  const std::array<int, 3> points = points_of(kind);
  const double spacing = size / (points[0] - 1);
  const Vec3 corner = -0.5 * spacing * Vec3(points[0] - 1, points[1] - 1, points[2] - 1);
  PhysicalModel model = cubic_lattice({.points = points,
                                       .spacing = spacing,
                                       .origin = corner,
                                       .springs = {stiffness, stiffness, stiffness},
                                       .name = name_of(kind)});
  for (PointId p : ids_of(model.points)) {
    const int i = p.value % points[0], j = p.value / points[0] % points[1];
    const int k = p.value / points[0] / points[1];
    if ((i + j + k) % 2 == 1) model.points[p].mass *= mass_ratio;
  }
  return model;
}

struct Frequencies {
  double small;  // rad/s at 1 N/m, of small vibrations
  double large;  // at any strain
};

// They go with the root of the stiffness, and have nothing to do with size.
const Frequencies& unit_frequencies(StabilityModel kind, double mass_ratio) {
  thread_local std::map<std::pair<StabilityModel, double>, Frequencies> known;
  const auto [entry, is_new] = known.try_emplace({kind, mass_ratio});
  if (is_new) {
    const PhysicalModel model = rest_model(kind, 1.0, mass_ratio, 1.0);
    entry->second = {exact_highest_frequency(model), large_strain_frequency(model)};
  }
  return entry->second;
}

// c / k, s.
double damping_time(const StabilityCase& tried) {
  if (tried.damping_ratio == 0.0) return 0.0;
  const double omega =
      std::sqrt(tried.stiffness) * unit_frequencies(tried.model, tried.mass_ratio).small;
  return 2.0 * tried.damping_ratio / omega;
}

// Along the springs of a row, every way in a block.
void perturb(PhysicalModel& model, const StabilityCase& tried) {
  Random random(1);
  const bool is_block = tried.model == StabilityModel::kBlock;
  const double most = kPerturbation * tried.size / (points_of(tried.model)[0] - 1);
  for (Vec3& x : model.geometry.points) {
    x.x() += random.in(-most, most);
    if (is_block) x += Vec3(0.0, random.in(-most, most), random.in(-most, most));
  }
}

void spoil(IdVector<PointId, Vec3>& points, ShapeDefect defect) {
  const PointId first(0u), second(1u);
  switch (defect) {
    case ShapeDefect::kNone:
      return;
    case ShapeDefect::kInsideOut:
      for (Vec3& x : points) x.x() *= -0.5;
      return;
    case ShapeDefect::kOneInverted:
      points[first] *= -0.5;
      return;
    case ShapeDefect::kFlat:
      for (Vec3& x : points) x.z() = 0.0;
      return;
    case ShapeDefect::kCoincident:
      points[second] = points[first];
      return;
    case ShapeDefect::kOnePlace:
      for (Vec3& x : points) x.setZero();
  }
}

Vec3 random_direction(Random& random) {
  const double height = random.in(-1.0, 1.0), angle = random.in(0.0, 2.0 * std::numbers::pi);
  const double radius = std::sqrt(1.0 - height * height);
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

void set_in_motion(PhysicalModel& model, const StabilityCase& tried) {
  Random random(2);
  double radius = 0.0;
  for (const Vec3& x : model.geometry.points) radius = std::max(radius, x.head<2>().norm());
  for (PointId p : ids_of(model.points)) {
    Vec3& v = model.points[p].velocity;
    const Vec3& x = model.geometry.points[p];
    switch (tried.motion) {
      case Motion::kTranslation:
        v = Vec3(0.6, 0.0, 0.8);
        break;
      case Motion::kSpin:
        v = Vec3(-x.y(), x.x(), 0.0) / radius;
        break;
      case Motion::kScatter:
        v = random_direction(random);
        break;
    }
    v *= tried.speed;
  }
}

}  // namespace

PhysicalModel stability_model(const StabilityCase& tried) {
  PhysicalModel model = rest_model(tried.model, tried.stiffness, tried.mass_ratio, tried.size);
  const double c_over_k = damping_time(tried);
  for (EdgeAttributes& edge : model.edges) edge.damping = c_over_k * edge.stiffness;
  perturb(model, tried);
  spoil(model.geometry.points, tried.defect);
  if (tried.speed > 0.0) set_in_motion(model, tried);
  for (Vec3& x : model.geometry.points) x.x() += tried.place;
  if (!tried.contacts) model.object.contact_share = 0.0;
  return model;
}

bool vibrates_little(const StabilityCase& tried) {
  const bool moves_within = tried.motion != Motion::kTranslation && tried.speed > 0.0;
  return tried.defect == ShapeDefect::kNone && !moves_within;
}

// Damping proportional to stiffness, c = beta k: the damping ratio of a mode is beta omega / 2, and
// the highest one has the smallest limit of all, with each of the schemes. At any strain a spring
// may be turned out of the direction that it damps, so that the least limit of all damping ratios
// up to that counts; half of critical is where Runge-Kutta 4 reaches least far.
double analytic_step_limit(const StabilityCase& tried) {
  const Frequencies& unit = unit_frequencies(tried.model, tried.mass_ratio);
  const double root = std::sqrt(tried.stiffness);
  const auto limit = tried.scheme.step_limit;
  if (vibrates_little(tried)) return limit(root * unit.small, tried.damping_ratio);
  const double omega = root * unit.large, most = tried.damping_ratio * unit.large / unit.small;
  return std::min({limit(omega, 0.0), limit(omega, std::min(most, 0.5)), limit(omega, most)});
}

}  // namespace limber
