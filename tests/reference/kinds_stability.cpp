// Group 4: highest frequencies, limits of the time step, frequencies of the integrators.
#include <cmath>

#include "core/analysis/periodic_lattice.h"
#include "core/analysis/vibration.h"
#include "core/dynamics/stable_step.h"
#include "tests/reference/build.h"
#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"
#include "tests/reference/oscillation.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

// ---- highest frequencies of lattices and of the infinite one

Json frequency_row(const Case& c, const Json& points) {
  Json params = c.params;
  params["points"] = points;
  const PhysicalModel model = cubic_model(params);
  const double omega = exact_highest_frequency(model);
  const FrequencyBounds bounds = frequency_bounds(model);
  Json row = points;
  for (double number :
       {static_cast<double>(model.points.size()), static_cast<double>(model.edges.size()), omega,
        stable_step(omega, 0.0), bounds.points, bounds.point_blocks, bounds.edges}) {
    row.push_back(number);
  }
  return row;
}

Json omega_max(const Case& c) {
  Json found;
  found["columns"] = {"nx",
                      "ny",
                      "nz",
                      "n_points",
                      "n_edges",
                      "omega_max",
                      "dt_crit_2_over_omega",
                      "gershgorin_point",
                      "gershgorin_block",
                      "gershgorin_edge"};
  for (const Json& points : c.inputs.at("rows")) {
    found["rows"].push_back(frequency_row(c, points));
  }
  const CubicLattice shape = cubic_of(c.params);
  const PlaneWave wave = highest_bulk_frequency(bulk_of(shape).lattice, shape.mass, shape.spacing);
  found["bulk_omega_max"] = wave.omega;
  found["bulk_argmax_qa"] = to_json(Vec3(shape.spacing * wave.wave_vector));
  return found;
}

// ---- stability limit

Vec3 of_point(const Eigen::VectorXd& shape, std::int32_t p) { return shape.segment<3>(3 * p); }

// Work of the forces at these velocities on the shape, per kg^1/2: what the time operator sums up.
double generalised_force(const PhysicalModel& model, const Eigen::VectorXd& shape, double speed) {
  Run run(model);
  Lattice& lattice = run.lattice();
  for (std::int32_t p : all_points(lattice)) {
    lattice.motion[p].velocity = speed * of_point(shape, p);
  }
  const std::vector<Vec3> forces = run.forces();
  double sum = 0.0;
  for (std::int32_t p : all_points(lattice)) sum += forces[p].dot(of_point(shape, p));
  return sum;
}

// Of a mode: force against its velocity, over twice its frequency.
double damping_ratio(const PhysicalModel& model, const Eigen::VectorXd& shape, double omega) {
  const double speed = model.edges[EdgeId(std::size_t{0})].rest_length * omega;
  const double force =
      generalised_force(model, shape, speed) - generalised_force(model, shape, 0.0);
  return -force / (2.0 * omega * speed);
}

// Displacement of the mode, with the points where their shape alone would have them.
double amplitude(const Lattice& lattice, const Eigen::VectorXd& shape) {
  double sum = 0.0;
  for (std::int32_t p : all_points(lattice)) {
    const Vec3 displacement = lattice.motion[p].position - lattice.authored_position[p];
    sum += lattice.mass[p] * displacement.dot(of_point(shape, p));
  }
  return sum;
}

// What a step of semi-implicit Euler multiplies a mode by at most, once this dominates: starts with
// a displacement of 1e-7 of the spacing.
double growth_of(Run& run, const Eigen::VectorXd& shape, double dt) {
  constexpr int kSamples = 12;
  Lattice& lattice = run.lattice();
  const double start = 1e-7 * lattice.springs[0].rest_length / shape.cwiseAbs().maxCoeff();
  for (std::int32_t p : all_points(lattice)) {
    const Vec3 displacement = start * of_point(shape, p);
    lattice.motion[p] = {lattice.authored_position[p] + displacement, Vec3::Zero()};
  }
  std::vector<double> samples;
  for (int i = 0; i < kSamples; ++i) {
    samples.push_back(amplitude(lattice, shape));
    run.step(dt);
  }
  return fit_recurrence(samples).largest_factor();
}

// Of the mode that grows most or dies out last. Those without stiffness do neither.
double growth_per_step(const PhysicalModel& model, const VibrationModes& modes, double dt) {
  Run run(model, {}, Integrator::kSymplecticEuler);
  double largest = 0.0;
  for (Eigen::Index i = zero_mode_count(modes); i < modes.shapes.cols(); ++i) {
    largest = std::max(largest, growth_of(run, modes.shapes.col(i), dt));
  }
  return largest;
}

Json stability_limit(const Case& c) {
  const PhysicalModel model = cubic_model(c.params);
  const VibrationModes modes = vibration_modes(model);
  const double omega = exact_highest_frequency(model);
  const double zeta = damping_ratio(model, modes.shapes.rightCols<1>(), omega);
  const double limit = stable_step(omega, zeta);
  Json found;
  found["omega_max"] = omega;
  found["zeta_at_omega_max"] = zeta;
  found["dt_limit_semi_implicit_euler"] = limit;
  found["dt_limit_undamped"] = stable_step(omega, 0.0);
  found["growth_per_step_at_1_02"] = growth_per_step(model, modes, 1.02 * limit);
  found["spectral_radius_at_0_98"] = growth_per_step(model, modes, 0.98 * limit);
  return found;
}

// ---- frequency of the integrators

PhysicalModel oscillator(const Json& p, double elongation) {
  const double half = 0.5 * (p.at("L0").get<double>() + elongation);
  return network({{Vec3(-half, 0.0, 0.0), p.at("m")}, {Vec3(half, 0.0, 0.0), p.at("m")}},
                 {{0, 1, p.at("k"), p.at("L0")}});
}

// Elongation after every step, as long as it stays clear of turning the spring inside out.
Recurrence recurrence_of(Integrator integrator, const Json& p, double elongation) {
  constexpr std::size_t kMostSamples = 5000;
  const double dt = p.at("dt"), most = 0.5 * p.at("L0").get<double>();
  Run run(oscillator(p, elongation), {}, integrator);
  std::vector<double> samples;
  while (samples.size() < kMostSamples && std::abs(stretch(run.lattice(), 0)) < most) {
    samples.push_back(stretch(run.lattice(), 0));
    run.step(dt);
  }
  return fit_recurrence(samples);
}

Json numerical_frequency(const Case& c) {
  constexpr double kSmall = 1e-2;  // explicit Euler grows
  const double dt = c.params.at("dt"), start = c.params.at("A");
  const Recurrence symplectic = recurrence_of(Integrator::kSymplecticEuler, c.params, start);
  const Recurrence rk4 = recurrence_of(Integrator::kRungeKutta4, c.params, start);
  const Recurrence euler = recurrence_of(Integrator::kExplicitEuler, c.params, kSmall * start);
  Json found;
  found["omega_exact"] = exact_highest_frequency(oscillator(c.params, 0.0));
  found["omega_numerical"] = symplectic.angle() / dt;
  found["omega_rk4"] = rk4.angle() / dt;
  found["rk4_amplitude_factor_per_step"] = rk4.largest_factor();
  found["explicit_euler_amplitude_factor_per_step"] = euler.largest_factor();
  return found;
}

}  // namespace

Kinds stability_kinds() {
  return {{"omega_max", omega_max},
          {"stability_limit", stability_limit},
          {"numerical_frequency", numerical_frequency}};
}

}  // namespace limber::reference
