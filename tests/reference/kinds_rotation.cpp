// Group 5: inertia, free rotation of rigid and of flexible bodies.
#include <cmath>
#include <numbers>

#include "core/analysis/vibration.h"
#include "core/dynamics/free_rotation.h"
#include "tests/reference/build.h"
#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

using std::numbers::pi;

Json inertia(const Case& c) {
  Json params = c.params;
  params["k1"] = params.value("k1", 1.0);  // does not matter
  const RigidMotion body = rigid_motion(compiled(cubic_model(params)));
  Json found;
  found["total_mass"] = body.mass;
  found["com"] = to_json(body.centre);
  found["I_diag"] = to_json(Vec3(body.inertia.diagonal()));
  return found;
}

// ---- rigid body, free to rotate

struct FreeBody {
  Vec3 moments;  // about its axes, kg m^2
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vec3 omega;  // world, rad/s

  Vec3 body_omega() const { return orientation.conjugate() * omega; }
  Vec3 momentum() const { return orientation * moments.cwiseProduct(body_omega()); }
  double energy() const { return 0.5 * omega.dot(momentum()); }
  void rotate(double dt) { rotate_freely(orientation, omega, moments, dt); }
};

constexpr double kTurn = 0.003;  // rad a step

FreeBody free_body(const Json& p) {
  return {.moments = vec3(p.at("I")), .omega = vec3(p.at("omega0"))};
}

void advance(FreeBody& body, double from, double to) {
  const int steps = 1 + static_cast<int>((to - from) * body.omega.norm() / kTurn);
  for (int i = 0; i < steps; ++i) body.rotate((to - from) / steps);
}

int intermediate_axis(const Vec3& moments) {
  for (int axis = 0; axis < 3; ++axis) {
    const double low = moments[(axis + 1) % 3], high = moments[(axis + 2) % 3];
    if ((low - moments[axis]) * (high - moments[axis]) <= 0.0) return axis;
  }
  return 0;
}

// When the component of omega along the body's axis changes its sign within dt: from then on.
double time_of_change(FreeBody body, int axis, double dt) {
  const FreeBody start = body;
  double before = 0.0, after = dt;
  while (after - before > 1e-13 * dt) {
    const double middle = 0.5 * (before + after);
    body = start;
    body.rotate(middle);
    const bool same = (body.body_omega()[axis] > 0.0) == (start.body_omega()[axis] > 0.0);
    (same ? before : after) = middle;
  }
  return after;
}

// The first moments when omega changes its sign along the intermediate axis, s.
std::vector<double> flips(FreeBody body, std::size_t count) {
  constexpr long kMostSteps = 50000000;
  const int axis = intermediate_axis(body.moments);
  std::vector<double> found;
  double time = 0.0;
  for (long i = 0; i < kMostSteps && found.size() < count; ++i) {
    const FreeBody before = body;
    const double dt = kTurn / body.omega.norm();
    body.rotate(dt);
    if ((body.body_omega()[axis] > 0.0) != (before.body_omega()[axis] > 0.0)) {
      found.push_back(time + time_of_change(before, axis, dt));
    }
    time += dt;
  }
  if (found.size() < count) throw std::runtime_error("the body does not flip");
  return found;
}

Json rigid_tennis_racket(const Case& c) {
  FreeBody body = free_body(c.params);
  const std::vector<double> at = flips(body, 3);
  Json found;
  found["half_period_flip"] = at[1] - at[0];
  found["period_omega_body"] = at[2] - at[0];
  double time = 0.0;
  for (double t : c.inputs.at("t")) {
    advance(body, time, t);
    time = t;
    found["omega_body"].push_back(to_json(body.body_omega()));
    found["rotation_matrix"].push_back(to_json(Mat3(body.orientation.toRotationMatrix())));
  }
  found["L_world"] = to_json(body.momentum());
  found["kinetic_energy"] = body.energy();
  return found;
}

// ---- lattice, free to rotate

void add_sample(const Lattice& lattice, const std::vector<std::int32_t>& corners, Json& found) {
  Json positions = Json::array();
  for (std::int32_t p : corners) positions.push_back(to_json(lattice.motion[p].position));
  found["corner_positions"].push_back(positions);
  found["best_fit_rotation"].push_back(to_json(rotation(lattice)));
  found["com"].push_back(to_json(rigid_motion(lattice).centre));
  found["elastic_energy"].push_back(elastic_energy(lattice));
}

Json flexible_rotation(const Case& c) {
  constexpr double kStepShare = 0.04;
  PhysicalModel model = cubic_model(c.params);
  centre(model);
  Json found;
  found["omega_max"] = exact_highest_frequency(model);
  set_in_motion(model, vec3(c.params.at("v0")), vec3(c.params.at("omega0")));
  const Vec3 gravity = gravity_of(c.params);
  Run run(model, {.gravity = gravity});
  found["momentum"] = to_json(rigid_motion(run.lattice()).momentum());
  for (double t : c.inputs.at("t")) {
    run.advance_to(t, kStepShare * run.stable_step());
    add_sample(run.lattice(), c.params.at("corner_indices"), found);
  }
  const RigidMotion body = rigid_motion(run.lattice());
  found["L_com"] = to_json(body.angular_momentum);
  found["total_energy_minus_gravity_work"] =
      energy(run.lattice()) - body.mass * gravity.dot(body.centre);
  return found;
}

// ---- steady spin

PhysicalModel spinning_model(const Json& p) {
  PhysicalModel model = cubic_model(p);
  const Vec3 omega(0.0, 0.0, p.at("omega"));
  for (PointId i : ids_of(model.points)) {
    model.geometry.points[i] = vec3(p.at("positions").at(i.index()));
    model.points[i].velocity = omega.cross(model.geometry.points[i]);
  }
  return model;
}

Json spin_equilibrium(const Case& c) {
  constexpr int kTurns = 10;
  constexpr double kStepShare = 0.05;
  Run run(spinning_model(c.params));
  const auto corner = [&] { return run.lattice().motion[0].position; };
  const double start = std::atan2(corner().y(), corner().x());
  run.advance_to(kTurns * 2.0 * pi / c.params.at("omega").get<double>(),
                 kStepShare * run.stable_step());
  const double end = std::atan2(corner().y(), corner().x());
  Json found;
  found["corner_radius"] = corner().head<2>().norm();
  found["angular_momentum_z"] = rigid_motion(run.lattice()).angular_momentum.z();
  found["energy"] = energy(run.lattice());
  found["max_elongation"] = largest_stretch(run.lattice());
  found["corner_angle_after_10_turns_minus_20pi"] = std::remainder(end - start, 2.0 * pi);
  return found;
}

}  // namespace

Kinds rotation_kinds() {
  return {{"inertia", inertia},
          {"rigid_tennis_racket", rigid_tennis_racket},
          {"flexible_rotation", flexible_rotation},
          {"spin_equilibrium", spin_equilibrium}};
}

}  // namespace limber::reference
