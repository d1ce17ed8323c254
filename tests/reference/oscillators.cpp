// Group 1: two points and chains that vibrate.
#include <cmath>
#include <numbers>

#include "core/analysis/vibration.h"
#include "core/dynamics/spring_force.h"
#include "tests/reference/build.h"
#include "tests/reference/kinds.h"
#include "tests/reference/mode_families.h"
#include "tests/reference/oscillation.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

using std::numbers::pi;

constexpr double kStepShare = 0.01;  // of the largest stable step

// ---- dumbbell: two points on one spring

PhysicalModel dumbbell_model(const Json& p) {
  const Vec3 velocity = vec3(p.at("vcom"));
  return network(
      {{vec3(p.at("X1")), p.at("m1"), velocity}, {vec3(p.at("X2")), p.at("m2"), velocity}},
      {{0, 1, p.at("k"), p.at("L0"), p.at("c")}});
}

double reduced_mass(const Lattice& lattice) {
  return 1.0 / (lattice.inverse_mass[0] + lattice.inverse_mass[1]);
}

// Of the spring's length, in free oscillation.
Oscillation oscillation_of(const PhysicalModel& model) {
  constexpr int kSamples = 100, kStepsBetween = 20;
  Run run(model);
  const double interval = kStepsBetween * kStepShare * run.stable_step();
  std::vector<double> samples;
  for (int i = 0; i < kSamples; ++i) {
    samples.push_back(stretch(run.lattice(), 0));
    run.advance_to((i + 1) * interval, kStepShare * run.stable_step());
  }
  return fit_oscillation(samples, interval);
}

void add_oscillation(const Oscillation& oscillation, Json& found) {
  found["omega0"] = oscillation.omega0;
  found["zeta"] = oscillation.zeta;
  if (oscillation.omega_d == 0.0) return;
  const double period = 2.0 * pi / oscillation.omega_d;
  found["omega_d"] = oscillation.omega_d;
  found["period_d"] = period;
  found["log_decrement"] = oscillation.zeta * oscillation.omega0 * period;
}

Json dumbbell(const Case& c) {
  const PhysicalModel model = dumbbell_model(c.params);
  Json found;
  add_oscillation(oscillation_of(model), found);
  Run run(model);
  found["reduced_mass"] = reduced_mass(run.lattice());
  for (double t : c.inputs.at("t")) {
    run.advance_to(t, kStepShare * run.stable_step());
    found["elongation"].push_back(stretch(run.lattice(), 0));
    found["elongation_rate"].push_back(stretch_rate(run.lattice(), 0));
    found["energy_rel_com"].push_back(energy_about_centre(run.lattice()));
    found["com_position"].push_back(to_json(rigid_motion(run.lattice()).centre));
  }
  found["momentum"] = to_json(rigid_motion(run.lattice()).momentum());
  return found;
}

// ---- rotating dumbbell

// Smaller: Runge-Kutta keeps angular momentum only to its fifth order.
constexpr double kRotatingStepShare = 0.004;

PhysicalModel rotating_model(const Json& p) {
  const double m1 = p.at("m1"), m2 = p.at("m2"), share = m1 / (m1 + m2), r0 = p.at("r0");
  const Vec3 separation(r0, 0.0, 0.0), velocity(p.at("vr"), p.at("vt"), 0.0);
  return network({{-(1.0 - share) * separation, m1, -(1.0 - share) * velocity},
                  {share * separation, m2, share * velocity}},
                 {{0, 1, p.at("k"), p.at("L0"), p.at("c")}});
}

Vec3 separation(const Lattice& lattice) {
  return lattice.motion[1].position - lattice.motion[0].position;
}

// Counts the angle of the edge in the xy plane beyond half a turn, as long as it is asked every
// step.
class AngleCounter {
 public:
  double count(const Vec3& direction) {
    const double angle = std::atan2(direction.y(), direction.x());
    angle_ += std::remainder(angle - angle_, 2.0 * pi);
    return angle_;
  }

 private:
  double angle_ = 0.0;
};

struct TurningPoint {
  double time, radius, angle;
};

// The first `count` moments when the separation stops growing or shrinking.
std::vector<TurningPoint> turning_points(Run& run, std::size_t count) {
  constexpr int kMostSteps = 1000000;
  const double dt = kRotatingStepShare * run.stable_step();
  AngleCounter angle;
  std::vector<TurningPoint> found;
  run.step(dt);  // away from a start at rest
  bool growing = stretch_rate(run.lattice(), 0) > 0.0;
  for (int i = 0; i < kMostSteps && found.size() < count; ++i) {
    const bool turned =
        run.step_until([&] { return (stretch_rate(run.lattice(), 0) > 0.0) != growing; }, dt);
    const Vec3 r = separation(run.lattice());
    const double counted = angle.count(r);
    if (!turned) continue;
    found.push_back({run.time(), r.norm(), counted});
    growing = !growing;
  }
  if (found.size() < count) throw std::runtime_error("the separation has no turning points");
  return found;
}

void add_radial_motion(const PhysicalModel& model, Json& found) {
  Run run(model);
  const std::vector<TurningPoint> turns = turning_points(run, 4);
  found["r_min"] = std::min(turns[0].radius, turns[1].radius);
  found["r_max"] = std::max(turns[0].radius, turns[1].radius);
  found["radial_period"] = turns[2].time - turns[0].time;
  found["apsidal_angle_per_period"] = std::abs(turns[2].angle - turns[0].angle);
}

// Where damping leads that, along the edge, leaves angular momentum alone.
void add_equilibrium(PhysicalModel model, Json& found) {
  constexpr double kZeta = 0.5, kDecays = 60.0;
  const double omega = exact_highest_frequency(model);
  EdgeAttributes& edge = model.edges[EdgeId(std::size_t{0})];
  edge.damping = 2.0 * kZeta * edge.stiffness / omega;
  Run run(std::move(model));
  run.advance_to(kDecays / (kZeta * omega), kRotatingStepShare * run.stable_step());
  found["r_equilibrium"] = separation(run.lattice()).norm();
  found["Omega_equilibrium"] = rigid_motion(run.lattice()).angular_velocity.norm();
  found["E_equilibrium"] = energy_about_centre(run.lattice());
}

Json rotating_dumbbell(const Case& c) {
  const PhysicalModel model = rotating_model(c.params);
  Json found;
  Run run(model);
  found["E_initial"] = energy_about_centre(run.lattice());
  AngleCounter angle;
  const auto count = [&] { angle.count(separation(run.lattice())); };
  for (double t : c.inputs.at("t")) {
    run.advance_to(t, kRotatingStepShare * run.stable_step(), count);
    found["separation"].push_back(separation(run.lattice()).norm());
    found["angle"].push_back(angle.count(separation(run.lattice())));
    found["energy_rel_com"].push_back(energy_about_centre(run.lattice()));
  }
  found["angular_momentum"] = rigid_motion(run.lattice()).angular_momentum.z();
  add_equilibrium(model, found);
  if (c.params.at("c").get<double>() == 0.0) add_radial_motion(model, found);
  return found;
}

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
  const Run at_rest(model);
  const double stiffness = at_rest.lattice().springs[0].stiffness;
  Json found;
  found["tension"] = spring_tension(stiffness, 0.0, stretch(at_rest.lattice(), 0), 0.0);
  found["omega_transverse"] = mode_families(model, Vec3::UnitX()).across;
  found["y"] = plucked(model, c, amplitude);
  found["y_linear"] = linear;
  return found;
}

}  // namespace

Kinds oscillator_kinds() {
  const auto chain_with = [](Ends ends) {
    return [ends](const Case& c) { return chain(c, ends); };
  };
  return {{"dumbbell", dumbbell},
          {"rotating_dumbbell", rotating_dumbbell},
          {"chain_fixed-fixed", chain_with({true, true})},
          {"chain_free-free", chain_with({false, false})},
          {"chain_fixed-free", chain_with({true, false})},
          {"taut_string", taut_string}};
}

}  // namespace limber::reference
