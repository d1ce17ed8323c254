// Group 1: two points on one spring.
#include <cmath>
#include <numbers>

#include "core/analysis/vibration.h"
#include "tests/reference/build.h"
#include "tests/reference/json_values.h"
#include "tests/reference/kinds.h"
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

// What the spring's force is to the relative acceleration it causes, kg.
double reduced_mass(const PhysicalModel& model) {
  Run run(model, {}, Integrator::kSymplecticEuler);
  const auto relative_velocity = [&] {
    return Vec3(run.lattice().motion[1].velocity - run.lattice().motion[0].velocity);
  };
  const Vec3 before = relative_velocity();
  const double dt = 0.1 * run.stable_step();
  run.step(dt);
  const Vec3 acceleration = (relative_velocity() - before) / dt;
  return run.lattice().force[1].dot(acceleration) / acceleration.squaredNorm();
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

// Period and decrement are but other words for what was fitted.
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
  found["reduced_mass"] = reduced_mass(model);
  Run run(model);
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
constexpr double kRotatingStepShare = 0.003;

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

// In the xy plane, rad.
double angle_of(const Vec3& direction) { return std::atan2(direction.y(), direction.x()); }

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
    const double counted = angle.count(angle_of(r));
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
  const auto count = [&] { return angle.count(angle_of(separation(run.lattice()))); };
  for (double t : c.inputs.at("t")) {
    run.advance_to(t, kRotatingStepShare * run.stable_step(), count);
    found["separation"].push_back(separation(run.lattice()).norm());
    found["angle"].push_back(count());
    found["energy_rel_com"].push_back(energy_about_centre(run.lattice()));
  }
  found["angular_momentum"] = rigid_motion(run.lattice()).angular_momentum.z();
  add_equilibrium(model, found);
  if (c.params.at("c").get<double>() == 0.0) add_radial_motion(model, found);
  return found;
}

}  // namespace

Kinds oscillator_kinds() {
  return {{"dumbbell", dumbbell}, {"rotating_dumbbell", rotating_dumbbell}};
}

}  // namespace limber::reference
