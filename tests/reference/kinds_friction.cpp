// Group 12: friction on the ground.

#include <cmath>
#include <numbers>

#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

using std::numbers::pi;

constexpr double kStep = 2e-5;  // s, of a body that turns

Ground hard_ground(double static_friction, double kinetic_friction) {
  Ground ground;
  ground.normal = Vec3::UnitZ();
  ground.static_friction = static_friction;
  ground.kinetic_friction = kinetic_friction;
  return ground;
}

// A lattice of 1 kg points that stands on z = 0. The cases mean it rigid: k = 1e8 N/m hardly
// deforms under friction. Stiffest along its axes: diagonals would lead a part of an upper layer's
// weight aside, and where a block stands on which of its points would depend on that. Damped, so
// that what starts to ring is rigid again soon.
PhysicalModel stiff_lattice(const std::array<int, 3>& points, double spacing, double stiffness) {
  CubicLattice shape;
  shape.points = points;
  shape.spacing = spacing;
  shape.springs = {.axial = stiffness, .face_diagonal = 0.01 * stiffness};
  shape.damping_per_stiffness = 1e-5;
  return cubic_model(shape);
}

// ---- a block on an incline ---------------------------------------------------------------------

struct Slope {
  double static_friction = 0.0, kinetic_friction = 0.0, g = 0.0;
};

// Flat ground and tilted gravity; down the slope is +x. One layer of points, so that all of them
// bear the same load and move alike: with two, the block would rock, and start to slide point by
// point. Nothing deforms it, so that soft springs do, which allow long steps.
Run block_on(const Slope& slope, double angle, double speed) {
  PhysicalModel block = stiff_lattice({3, 3, 1}, 0.1, 1e4);
  set_in_motion(block, speed * Vec3::UnitX(), Vec3::Zero());
  const Vec3 gravity = slope.g * Vec3(std::sin(angle), 0.0, -std::cos(angle));
  return Run(std::move(block),
             {.gravity = gravity,
              .air = {},
              .ground = hard_ground(slope.static_friction, slope.kinetic_friction)});
}

double speed_of(const Run& run) { return rigid_motion(run.lattice()).velocity.x(); }
double place_of(const Run& run) { return rigid_motion(run.lattice()).centre.x(); }

constexpr double kCreep = 1e-9;  // m/s: slower is at rest

// The steepest angle at which a block that is let go stays, rad.
double critical_angle(const Slope& slope) {
  double holds = 0.0, slides = 0.5 * pi;
  constexpr double kShort = 1e-5;  // s
  while (slides - holds > 1e-6) {
    const double angle = 0.5 * (holds + slides);
    Run run = block_on(slope, angle, 0.0);
    run.advance_to(20 * kShort, kShort);
    (std::abs(speed_of(run)) < kCreep ? holds : slides) = angle;
  }
  return 0.5 * (holds + slides);
}

// What the ground did so far.
struct Ledger {
  double duration = 0.0;        // s
  Vec3 impulse = Vec3::Zero();  // N s
  double friction_J = 0.0;

  void add(const StepReport& report, double dt) {
    duration += dt;
    impulse += report.ground.impulse;
    friction_J += report.ground.friction_J;
  }
};

Json of_ground(const Ledger& ledger, double mass) {
  return {{"normal_force_per_mass", ledger.impulse.z() / (mass * ledger.duration)},
          {"friction_work_per_mass", -ledger.friction_J / mass}};
}

// Steps over what is watched: the ledger of friction is of first order in the step.
constexpr int kSteps = 50000;

// Let go: what it did after a time.
Json let_go(Run& run, double duration) {
  const double start = place_of(run), dt = duration / kSteps;
  Ledger ledger;
  for (int n = 0; n < kSteps; ++n) ledger.add(run.step(dt), dt);
  Json result = of_ground(ledger, rigid_motion(run.lattice()).mass);
  result["slides"] = std::abs(speed_of(run)) > kCreep;
  result["acceleration"] = speed_of(run) / duration;
  result["displacement_at_t"] = place_of(run) - start;
  return result;
}

// How long to look at a body that is pushed and gets faster and faster, s. The cases expect the
// work of friction over this time; it stands nowhere in them.
constexpr double kWatched = 0.5;

// When a pushed block will be at rest, by how its first steps slow it down; kWatched if they do
// not.
double time_to_rest(Run probe) {
  const double first = std::abs(speed_of(probe));
  probe.advance_to(1e-4, 1e-5);
  const double slowing = (first - std::abs(speed_of(probe))) / probe.time();
  return slowing > 0.0 ? first / slowing : kWatched;
}

// Pushed: until it stops, or is faster than at first when the time to look is over.
Json pushed(Run& run, double time_to_look) {
  const double start = place_of(run), first = std::abs(speed_of(run)), dt = time_to_look / kSteps;
  const double sense = std::copysign(1.0, speed_of(run));
  const auto speed = [&] { return sense * speed_of(run); };  // > 0 in the sense of the push
  Ledger ledger;
  double last = 0.0;  // before the last step, m/s
  while (speed() > kCreep && run.time() < 2.0 * time_to_look) {
    if (speed() > first && run.time() > time_to_look - 0.5 * dt) break;
    last = speed();
    ledger.add(run.step(dt), dt);
  }
  Json result = of_ground(ledger, rigid_motion(run.lattice()).mass);
  if (speed() > kCreep) return result;
  // It stopped within the last step, where the straight line of its speed leads to.
  result["stop_time"] = (run.time() - dt) * first / (first - last);
  result["stop_distance"] = std::abs(place_of(run) - start);
  run.advance_to(run.time() + 0.2, dt);
  result["stays_after_stop"] = std::abs(speed()) < kCreep;
  return result;
}

Json incline(const Case& c) {
  const Slope slope{c.params.at("mu_static"), c.params.at("mu_kinetic"), c.params.at("g")};
  const double angle = c.params.at("theta"), speed = c.params.at("v0");
  const double down = c.params.value("push_up", false) ? -speed : speed;
  Run run = block_on(slope, angle, down);
  Json result = speed == 0.0 ? let_go(run, c.inputs.value("t", 1.0))
                             : pushed(run, time_to_rest(block_on(slope, angle, down)));
  result["critical_angle"] = critical_angle(slope);
  return result;
}

// ---- a spinning plate or block -----------------------------------------------------------------

Run on_flat_ground(const Json& params, const Vec3& velocity) {
  PhysicalModel model =
      stiff_lattice(params.at("points").get<std::array<int, 3>>(), params.at("a"), 1e8);
  set_in_motion(model, velocity, params.at("omega0").get<double>() * Vec3::UnitZ());
  const double mu = params.at("mu");
  return Run(std::move(model),
             {.gravity = gravity_of(params), .air = {}, .ground = hard_ground(mu, mu)});
}

double spin_of(const Run& run) { return rigid_motion(run.lattice()).angular_velocity.z(); }

// About z, from where it was authored, rad.
double turn_of(const Run& run) {
  const Mat3 R = rotation(run.lattice());
  return std::atan2(R(1, 0), R(0, 0));
}

// The last of the spin is lost point by point, within few steps: the deceleration is that before,
// and the time that it would stop the body in.
constexpr double kSlowingUntil = 0.02, kStopped = 1e-6;  // shares of the first spin

Json spin_down(const Case& c) {
  Run run = on_flat_ground(c.params, Vec3::Zero());
  const double first = spin_of(run);
  const auto left = [&] { return spin_of(run) / first; };
  AngleCounter turned;
  double angle = 0.0, slowing = 0.0;
  while (left() > kStopped && run.time() < 100.0) {
    if (left() > kSlowingUntil) slowing = (1.0 - left()) * std::abs(first) / run.time();
    run.step(kStep);
    angle = turned.count(turn_of(run));
  }
  return {{"angular_deceleration", slowing},
          {"stop_time", std::abs(first) / slowing},
          {"stop_angle", std::abs(angle)}};
}

Json slide_and_spin(const Case& c) {
  const Json& v0 = c.params.at("v0");
  Run run = on_flat_ground(c.params, Vec3(v0.at(0), v0.at(1), 0.0));
  const Vec3 start = rigid_motion(run.lattice()).centre;
  AngleCounter turning;
  Json com = Json::array(), velocity = Json::array(), angle = Json::array(), spin = Json::array();
  for (double time : c.inputs.at("t")) {
    double turned = 0.0;
    run.advance_to(time, kStep, [&] { turned = turning.count(turn_of(run)); });
    const RigidMotion body = rigid_motion(run.lattice());
    com.push_back({body.centre.x() - start.x(), body.centre.y() - start.y()});
    velocity.push_back({body.velocity.x(), body.velocity.y()});
    angle.push_back(turned);
    spin.push_back(body.angular_velocity.z());
  }
  return {{"com", com}, {"velocity", velocity}, {"angle", angle}, {"omega", spin}};
}

}  // namespace

Kinds friction_kinds() {
  return {{"incline", incline}, {"spin_down", spin_down}, {"slide_and_spin", slide_and_spin}};
}

}  // namespace limber::reference
