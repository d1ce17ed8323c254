// Group 12: friction on the ground. Its other kinds are in point_drop.cpp and equipartition.cpp,
// but for those with rigid bodies, which are left out.

#include <cmath>
#include <numbers>

#include "tests/reference/grid.h"
#include "tests/reference/parts.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

using std::numbers::pi;

constexpr double kStep = 2e-5;       // s
constexpr double kSlideStep = 1e-5;  // s, on the incline: the ledger of friction is of first order

Ground hard_ground(double static_friction, double kinetic_friction) {
  Ground ground;
  ground.normal = Vec3::UnitZ();
  ground.static_friction = static_friction;
  ground.kinetic_friction = kinetic_friction;
  return ground;
}

// A lattice of 1 kg points that stands on z = 0, so stiff that it hardly deforms. Stiffest along
// its axes: diagonals would lead a part of an upper layer's weight aside, and where a block stands
// on which of its points would depend on that. Damped, so that what starts to ring is rigid again
// soon.
PhysicalModel stiff_lattice(const std::array<int, 3>& points, double spacing) {
  CubicLattice shape;
  shape.points = points;
  shape.spacing = spacing;
  shape.springs = {.axial = 1e8, .face_diagonal = 1e6};
  shape.damping_per_stiffness = 1e-5;
  PhysicalModel model = cubic_lattice(shape);
  model.object.contact_share = 0.0;
  return model;
}

// ---- a block on an incline ---------------------------------------------------------------------

struct Slope {
  double static_friction = 0.0, kinetic_friction = 0.0, g = 0.0;
};

// Flat ground and tilted gravity; down the slope is +x. One layer of points, so that all of them
// bear the same load: with two, the block would rock, and start to slide point by point.
Run block_on(const Slope& slope, double angle, double speed) {
  PhysicalModel block = stiff_lattice({3, 3, 1}, 0.1);
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
  while (slides - holds > 1e-6) {
    const double angle = 0.5 * (holds + slides);
    Run run = block_on(slope, angle, 0.0);
    run.advance_to(20 * kSlideStep, kSlideStep);
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

// Let go: what it did after a time.
Json let_go(Run& run, double duration) {
  Ledger ledger;
  const double start = place_of(run);
  const int steps = static_cast<int>(std::round(duration / kSlideStep));
  for (int n = 0; n < steps; ++n) ledger.add(run.step(duration / steps), duration / steps);
  Json result = of_ground(ledger, rigid_motion(run.lattice()).mass);
  result["slides"] = std::abs(speed_of(run)) > kCreep;
  result["acceleration"] = speed_of(run) / duration;
  result["displacement_at_t"] = place_of(run) - start;
  return result;
}

// Pushed: until it stops or, where it gets faster and faster, for half a second.
Json pushed(Run& run) {
  Ledger ledger;
  const double start = place_of(run), first = speed_of(run), sense = first < 0.0 ? -1.0 : 1.0;
  const auto speed = [&] { return sense * speed_of(run); };  // > 0 in the sense of the push
  double last = 0.0;                                         // before the last step, m/s
  while (speed() > kCreep && run.time() < 100.0) {
    if (speed() > sense * first && run.time() > 0.5 - 0.5 * kSlideStep) break;
    last = speed();
    ledger.add(run.step(kSlideStep), kSlideStep);
  }
  Json result = of_ground(ledger, rigid_motion(run.lattice()).mass);
  if (speed() > kCreep) return result;
  // It stopped within the last step, where the straight line of its speed leads to.
  result["stop_time"] = (run.time() - kSlideStep) * sense * first / (sense * first - last);
  result["stop_distance"] = std::abs(place_of(run) - start);
  run.advance_to(run.time() + 0.2, kSlideStep);
  result["stays_after_stop"] = std::abs(speed()) < kCreep;
  return result;
}

Json incline(const Case& c) {
  const Slope slope{c.params.at("mu_static"), c.params.at("mu_kinetic"), c.params.at("g")};
  const double speed = c.params.at("v0");
  const double down = c.params.value("push_up", false) ? -speed : speed;
  Run run = block_on(slope, c.params.at("theta"), down);
  Json result = speed == 0.0 ? let_go(run, c.inputs.value("t", 1.0)) : pushed(run);
  result["critical_angle"] = critical_angle(slope);
  return result;
}

// ---- a spinning plate or block -----------------------------------------------------------------

Run on_flat_ground(const Json& params, const Vec3& velocity) {
  PhysicalModel model =
      stiff_lattice(params.at("points").get<std::array<int, 3>>(), params.at("a"));
  set_in_motion(model, velocity, params.at("omega0").get<double>() * Vec3::UnitZ());
  const double mu = params.at("mu");
  const Vec3 gravity(0.0, 0.0, -params.at("g").get<double>());
  return Run(std::move(model), {.gravity = gravity, .air = {}, .ground = hard_ground(mu, mu)});
}

double spin_of(const Run& run) { return rigid_motion(run.lattice()).angular_velocity.z(); }

// How far a lattice has turned about z since it was authored, rad, counted on from step to step.
class Turning {
 public:
  double update(const Lattice& lattice) {
    const Mat3 R =
        best_rotation(lattice.motion, lattice.authored_position, lattice.mass, all_points(lattice));
    const double now = std::atan2(R(1, 0), R(0, 0));
    angle_ += std::remainder(now - angle_, 2.0 * pi);
    return angle_;
  }

 private:
  double angle_ = 0.0;
};

Json spin_down(const Case& c) {
  Run run = on_flat_ground(c.params, Vec3::Zero());
  const double first = spin_of(run);
  const double creep = 1e-6 * std::abs(first);
  Turning turning;
  double last = first, angle = 0.0;
  while (spin_of(run) * first > creep * std::abs(first) && run.time() < 100.0) {
    last = spin_of(run);
    run.step(kStep);
    angle = turning.update(run.lattice());
  }
  const double slowing = std::abs(first - last) / (run.time() - kStep);
  return {{"angular_deceleration", slowing},
          {"stop_time", std::abs(first) / slowing},
          {"stop_angle", std::abs(angle)}};
}

Json slide_and_spin(const Case& c) {
  const Json& v0 = c.params.at("v0");
  Run run = on_flat_ground(c.params, Vec3(v0.at(0), v0.at(1), 0.0));
  const Vec3 start = rigid_motion(run.lattice()).centre;
  Turning turning;
  Json com = Json::array(), velocity = Json::array(), angle = Json::array(), spin = Json::array();
  for (double time : c.inputs.at("t")) {
    double turned = 0.0;
    run.advance_to(time, kStep, [&] { turned = turning.update(run.lattice()); });
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
  Kinds kinds = {
      {"incline", incline}, {"spin_down", spin_down}, {"slide_and_spin", slide_and_spin}};
  kinds.merge(drop_kinds());
  kinds.merge(equipartition_kinds());
  return kinds;
}

}  // namespace limber::reference
