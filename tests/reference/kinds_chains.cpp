// Group 1: chains that vibrate along themselves, strings that vibrate across.
#include <cmath>
#include <numbers>

#include "tests/reference/build.h"
#include "tests/reference/kinds.h"
#include "tests/reference/mode_families.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

using std::numbers::pi;

constexpr double kStepShare = 0.01;  // of the largest stable step

// ---- chains along x

struct Ends {
  bool first_pinned, last_pinned;  // by a further point beyond the end
};

PhysicalModel chain_model(const Json& p, const Ends& ends) {
  const double a = p.at("a"), m = p.at("m");
  const int n = p.at("n");
  std::vector<MassPoint> points;
  if (ends.first_pinned) points.push_back({Vec3::Zero(), m, Vec3::Zero(), true});
  for (int i = 1; i <= n; ++i) points.push_back({Vec3(i * a, 0.0, 0.0), m});
  if (ends.last_pinned) points.push_back({Vec3((n + 1) * a, 0.0, 0.0), m, Vec3::Zero(), true});
  return network(points, chain_bonds(points.size(), p.at("k"), a, p.at("c")));
}

std::vector<double> displacements(const Lattice& lattice, int axis) {
  std::vector<double> found;
  for (std::int32_t p : free_points(lattice)) {
    found.push_back(lattice.motion[p].position[axis] - lattice.authored_position[p][axis]);
  }
  return found;
}

void displace(Lattice& lattice, int axis, const std::vector<double>& by) {
  const std::vector<std::int32_t> points = free_points(lattice);
  for (std::size_t i = 0; i < points.size(); ++i) {
    lattice.motion[points[i]].position[axis] += by.at(i);
  }
}

Json chain(const Case& c, const Ends& ends) {
  const PhysicalModel model = chain_model(c.params, ends);
  Json found;
  found["omega"] = mode_families(model, Vec3::UnitX()).along;
  Run run(model);
  displace(run.lattice(), 0, c.params.at("u0"));
  for (double t : c.inputs.at("t")) {
    run.advance_to(t, kStepShare * run.stable_step());
    found["displacement"].push_back(displacements(run.lattice(), 0));
    found["energy"].push_back(energy(run.lattice()));
  }
  return found;
}

// ---- taut string

PhysicalModel string_model(const Json& p) {
  const double a = p.at("a"), m = p.at("m");
  const int n = p.at("n");
  std::vector<MassPoint> points;
  for (int i = 0; i <= n + 1; ++i) {
    points.push_back({Vec3(i * a, 0.0, 0.0), m, Vec3::Zero(), i == 0 || i == n + 1});
  }
  return network(points, chain_bonds(points.size(), p.at("k"), p.at("L0")));
}

// y of every free point at the sample times, of a string plucked in y.
std::vector<std::vector<double>> plucked(const PhysicalModel& model, const Case& c,
                                         double amplitude) {
  Run run(model);
  std::vector<double> start;
  const int n = c.params.at("n"), mode = c.params.at("mode");
  for (int i = 1; i <= n; ++i) start.push_back(amplitude * std::sin(mode * pi * i / (n + 1)));
  displace(run.lattice(), 1, start);
  std::vector<std::vector<double>> found;
  for (double t : c.inputs.at("t")) {
    run.advance_to(t, kStepShare * run.stable_step());
    found.push_back(displacements(run.lattice(), 1));
  }
  return found;
}

Json taut_string(const Case& c) {
  constexpr double kSmall = 1e-4;  // of the amplitude: linear to its square
  const PhysicalModel model = string_model(c.params);
  const double amplitude =
      c.params.at("rel_amplitude").get<double>() * c.params.at("a").get<double>();
  auto linear = plucked(model, c, kSmall * amplitude);
  for (auto& row : linear) {
    for (double& y : row) y /= kSmall;
  }
  Json found;
  found["tension"] = tension(compiled(model), 0);
  found["omega_transverse"] = mode_families(model, Vec3::UnitX()).across;
  found["y"] = plucked(model, c, amplitude);
  found["y_linear"] = linear;
  return found;
}

}  // namespace

Kinds chain_kinds() {
  const auto chain_with = [](Ends ends) {
    return [ends](const Case& c) { return chain(c, ends); };
  };
  return {{"chain_fixed-fixed", chain_with({true, true})},
          {"chain_free-free", chain_with({false, false})},
          {"chain_fixed-free", chain_with({true, false})},
          {"taut_string", taut_string}};
}

}  // namespace limber::reference
