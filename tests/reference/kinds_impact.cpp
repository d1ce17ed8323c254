// Group 7: impact and breaking.
#include <algorithm>
#include <cmath>

#include "core/analysis/vibration.h"
#include "tests/reference/build.h"
#include "tests/reference/cubic.h"
#include "tests/reference/edge_recorder.h"
#include "tests/reference/kinds.h"

namespace limber::reference {
namespace {

constexpr double kStepShare = 0.025;  // of the largest stable step

// ---- bar on a floor

void add_bar_elongations(const Case& c, const Run& run, const EdgeRecorder& edges, Json& found) {
  const double spacing = c.params.at("a");
  Json& families = found["max_elongation_by_family"] = Json::object();
  for (std::size_t e = 0; e < edges.peaks().size(); ++e) {
    const std::string family = family_of(run.lattice().springs[e].rest_length, spacing);
    families[family] = std::max(families.value(family, 0.0), edges.distance(e));
  }
  const std::size_t edge = edges.farthest();
  const Spring& spring = run.lattice().springs[edge];
  found["max_abs_elongation_overall"] = {
      {"value", edges.distance(edge)},
      {"edge", {std::min(spring.a, spring.b), std::max(spring.a, spring.b)}},
      {"time", edges.peaks()[edge].farthest().time}};
  // Elongations are proportional to the speed; the kind asks for a strain of 0.05 along the axes.
  found["critical_speed_estimate"] =
      c.params.at("v").get<double>() * 0.05 * spacing / edges.distance(edge);
}

Json bar3d_impact(const Case& c) {
  PhysicalModel model = cubic_model(c.params);
  set_in_motion(model, Vec3(0.0, 0.0, -c.params.at("v").get<double>()), Vec3::Zero());
  Ground floor{.normal = Vec3::UnitZ()};
  floor.stiffness = c.params.at("k_wall");
  Run run(std::move(model), {.ground = floor});
  EdgeRecorder edges(run);
  const auto advance_to = [&](double t) {
    run.advance_to(t, kStepShare * run.stable_step(), [&] { edges.read(run); });
  };
  Json found;
  for (double t : c.inputs.at("t")) {
    advance_to(t);
    found["momentum_z"].push_back(rigid_motion(run.lattice()).momentum().z());
    found["max_abs_elongation_at_t"].push_back(largest_stretch(run.lattice()));
  }
  advance_to(c.params.at("t_end"));
  found["final_com_speed"] = rigid_motion(run.lattice()).velocity.z();
  found["final_positions"] = to_json(positions(run.lattice()));
  add_bar_elongations(c, run, edges, found);
  return found;
}

// ---- two points that part

PhysicalModel parting(const Json& p, double speed) {
  const double m1 = p.at("m1"), m2 = p.at("m2"), share = m1 / (m1 + m2), length = p.at("L0");
  const Vec3 velocity(speed * p.at("sign").get<double>(), 0.0, 0.0);
  return network({{Vec3::Zero(), m1, -(1.0 - share) * velocity},
                  {Vec3(length, 0.0, 0.0), m2, share * velocity}},
                 {{0, 1, p.at("k"), length, p.at("c")}});
}

// The first turning point of the unbroken spring at a speed that hardly stretches it; its distance
// is proportional to the speed.
double speed_that_stretches_to(const Json& p, double threshold) {
  const double omega = exact_highest_frequency(parting(p, 0.0));
  const double speed = 1e-2 * p.at("L0").get<double>() * omega;
  Run run(parting(p, speed));
  const Reading turn = first_extrema(run, {0}, kStepShare * run.stable_step(), 0.0).front();
  return speed * threshold / std::abs(turn.value);
}

void add_parting(const Run& run, double elastic_before, double time, Json& found) {
  const Lattice& lattice = run.lattice();
  const double v1 = lattice.motion[0].velocity.x(), v2 = lattice.motion[1].velocity.x();
  found["break_time"] = time;
  found["relative_speed_after"] = v2 - v1;
  found["v1_after"] = v1;
  found["v2_after"] = v2;
  found["elastic_energy_removed"] = elastic_before;
  found["energy_after"] = energy_about_centre(lattice);
}

// Steps short enough to see the break within a ten-thousandth of the threshold.
Json dumbbell_break(const Case& c) {
  const double threshold = c.params.at("break_threshold"), speed = c.params.at("v");
  PhysicalModel model = parting(c.params, speed);
  break_either_way(model, threshold);
  const double omega = exact_highest_frequency(model);
  Run run(std::move(model));
  const double dt = std::min(1e-4 * threshold / speed, 1e-3 * run.stable_step());
  Json found;
  found["critical_speed"] = speed_that_stretches_to(c.params, threshold);
  found["breaks"] = false;
  while (run.time() * omega < 10.0) {  // more than one and a half periods
    const double elastic = elastic_energy(run.lattice());
    const StepReport report = run.step(dt);
    if (report.breaks.empty()) continue;
    found["breaks"] = true;
    add_parting(run, elastic, report.breaks[0].time, found);
    break;
  }
  return found;
}

// ---- chain that hangs and breaks by its own weight

PhysicalModel hanging_model(const Json& p) {
  const double mass = p.at("m");
  std::vector<MassPoint> points = {{Vec3::Zero(), mass, Vec3::Zero(), true}};
  for (double z : p.at("z")) points.push_back({Vec3(0.0, 0.0, z), mass});
  PhysicalModel model = network(points, chain_bonds(points.size(), p.at("k"), p.at("L0")));
  break_either_way(model, p.at("break_threshold"));
  return model;
}

Json hanging_break(const Case& c) {
  Run run(hanging_model(c.params), {.gravity = gravity_of(c.params)});
  const StepReport first = run.step(1e-6 * run.stable_step());
  Json found;
  found["n_broken_at_once"] = first.breaks.size();
  found["broken_edge_from_top"] = first.breaks.empty() ? -1 : first.breaks[0].edge;
  for (double t : c.inputs.at("t")) {
    run.advance_to(t, kStepShare * run.stable_step());
    const Lattice& lattice = run.lattice();
    const RigidMotion body =
        limber::rigid_motion(lattice.motion, lattice.mass, free_points(lattice));
    found["com_z"].push_back(body.centre.z());
  }
  const auto& broken = run.lattice().breaking.edge_broken;
  found["breaks"] = std::count(broken.begin(), broken.end(), 1) > 0;
  return found;
}

}  // namespace

Kinds impact_kinds() {
  return {{"bar3d_impact", bar3d_impact},
          {"dumbbell_break", dumbbell_break},
          {"hanging_break", hanging_break}};
}

}  // namespace limber::reference
