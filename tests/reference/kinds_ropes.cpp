// Group 2: hanging chains, catenaries and pendulums.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/analysis/equilibrium.h"
#include "tests/reference/build.h"
#include "tests/reference/json_values.h"
#include "tests/reference/kinds.h"
#include "tests/reference/mode_families.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

// Point 0 pinned at the origin, the others below it at rest length.
PhysicalModel hanging_model(const Json& p) {
  const int n = p.at("n");
  const double mass = p.at("m"), spacing = p.at("L0");
  std::vector<MassPoint> points = {{Vec3::Zero(), mass, Vec3::Zero(), true}};
  for (int i = 1; i <= n; ++i) points.push_back({Vec3(0.0, 0.0, -i * spacing), mass});
  points.back().mass = p.value("m_end", mass);
  return network(points, chain_bonds(points.size(), p.at("k"), spacing));
}

// What holds point 0 against the springs alone: the support has no weight.
Vec3 load_on_pin(const PhysicalModel& model) {
  return support_forces(model, Vec3::Zero())[PointId(std::size_t{0})];
}

std::vector<double> coordinates(const Lattice& lattice, int axis) {
  std::vector<double> found;
  for (std::int32_t p : free_points(lattice)) found.push_back(lattice.motion[p].position[axis]);
  return found;
}

std::vector<double> stretches(const Lattice& lattice) {
  std::vector<double> found;
  for (std::size_t e = 0; e < lattice.springs.size(); ++e) found.push_back(stretch(lattice, e));
  return found;
}

Json hanging_chain(const Case& c) {
  PhysicalModel model = hanging_model(c.params);
  const Vec3 gravity = gravity_of(c.params);
  settle_or_throw(model, gravity);
  const Lattice lattice = compiled(model);
  const std::vector<double> elongation = stretches(lattice);
  Json found;
  found["z"] = coordinates(lattice, 2);
  found["elongation"] = elongation;
  found["total_extension"] = std::accumulate(elongation.begin(), elongation.end(), 0.0);
  found["support_force"] = load_on_pin(model).norm();
  found["elastic_energy"] = elastic_energy(lattice);
  return found;
}

// Hangs in a parabola from the start, below the line between its ends: of two equilibria, one is
// unstable.
PhysicalModel rope_model(const Json& p) {
  const int n = p.at("n");
  const double mass = p.at("m"), spacing = p.at("L0");
  const Vec3 span(p.at("span"), 0.0, p.at("dz"));
  const double length = (n + 1) * spacing, slack = length * length - span.squaredNorm();
  const double sag = 0.5 * std::sqrt(std::max(slack, 0.01 * length * length));
  std::vector<MassPoint> points;
  for (int i = 0; i <= n + 1; ++i) {
    const double s = static_cast<double>(i) / (n + 1);
    const Vec3 position = s * span - 4.0 * s * (1.0 - s) * sag * Vec3::UnitZ();
    points.push_back({position, mass, Vec3::Zero(), i == 0 || i == n + 1});
  }
  return network(points, chain_bonds(points.size(), p.at("k"), spacing));
}

void add_tensions(const Lattice& lattice, Json& found) {
  double least = kUnbreakable, most = 0.0, strain = 0.0;
  for (std::size_t e = 0; e < lattice.springs.size(); ++e) {
    least = std::min(least, tension(lattice, e));
    most = std::max(most, tension(lattice, e));
    strain = std::max(strain, stretch(lattice, e) / lattice.springs[e].rest_length);
  }
  found["T_min"] = least;
  found["T_max"] = most;
  found["strain_max"] = strain;
}

Json catenary(const Case& c) {
  PhysicalModel model = rope_model(c.params);
  const Vec3 gravity = gravity_of(c.params);
  settle_or_throw(model, gravity);
  const Lattice lattice = compiled(model);
  const std::vector<double> z = coordinates(lattice, 2);
  Json found;
  found["x"] = coordinates(lattice, 0);
  found["z"] = z;
  found["sag"] = -*std::min_element(z.begin(), z.end());
  found["H"] = std::abs(load_on_pin(model).x());
  found["elastic_energy"] = elastic_energy(lattice);
  add_tensions(lattice, found);
  return found;
}

// ---- pendulum

constexpr double kStepShare = 0.03;  // of the largest stable step

PhysicalModel pendulum_model(const Json& p) {
  const double angle = p.at("theta0"), mass = p.at("m"), radius = p.at("r0");
  const Vec3 bob = radius * Vec3(std::sin(angle), 0.0, -std::cos(angle));
  return network({{Vec3::Zero(), mass, Vec3::Zero(), true}, {bob, mass}},
                 {{0, 1, p.at("k"), p.at("l0")}});
}

// The first moments when the bob is below the pin, s.
std::vector<double> crossings(Run& run, std::size_t count) {
  constexpr long kMostSteps = 20000000;
  const auto x = [&] { return run.lattice().motion[1].position.x(); };
  std::vector<double> found;
  bool right = x() > 0.0;
  for (long i = 0; i < kMostSteps && found.size() < count; ++i) {
    if (!run.step_until([&] { return (x() > 0.0) != right; }, kStepShare * run.stable_step())) {
      continue;
    }
    found.push_back(run.time());
    right = !right;
  }
  if (found.size() < count) throw std::runtime_error("the pendulum does not swing");
  return found;
}

void add_crossings(const PhysicalModel& model, const Environment& environment, Json& found) {
  Run run(model, environment);
  const std::vector<double> at = crossings(run, 3);
  found["first_crossings_x0"] = at;
  found["half_period_from_crossings"] = at[1] - at[0];
  found["period_rigid"] = at[2] - at[0];
}

Json pendulum(const Case& c) {
  const PhysicalModel model = pendulum_model(c.params);
  const Environment environment{.gravity = gravity_of(c.params)};
  Json found;
  add_crossings(model, environment, found);
  Run run(model, environment);
  for (double t : c.inputs.at("t")) {
    run.advance_to(t, kStepShare * run.stable_step());
    const Vec3 bob = run.lattice().motion[1].position;
    found["x"].push_back(bob.x());
    found["z"].push_back(bob.z());
  }
  const double height_energy =
      -run.lattice().mass[1] * environment.gravity.dot(run.lattice().motion[1].position);
  found["energy"] = energy(run.lattice()) + height_energy;
  return found;
}

// ---- small oscillations

Json hanging_chain_modes(const Case& c) {
  PhysicalModel model = hanging_model(c.params);
  settle_or_throw(model, gravity_of(c.params));
  const ModeFamilies modes = mode_families(model, Vec3::UnitZ());
  Json found;
  found["omega_transverse"] = modes.across;
  found["omega_longitudinal"] = modes.along;
  found["mode1_shape_lowest_is_1"] = modes.lowest_shape_across;
  return found;
}

}  // namespace

Kinds rope_kinds() {
  return {{"hanging_chain", hanging_chain},
          {"catenary", catenary},
          {"pendulum", pendulum},
          {"hanging_chain_modes", hanging_chain_modes}};
}

}  // namespace limber::reference
