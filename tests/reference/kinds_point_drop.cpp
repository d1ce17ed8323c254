// Group 12: a point dropped on a soft ground.

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/reference/build.h"
#include "tests/reference/json_values.h"
#include "tests/reference/kinds.h"
#include "tests/reference/run.h"

namespace limber::reference {
namespace {

Ground soft_ground(const Json& params, bool adhesive) {
  Ground ground;
  ground.normal = Vec3::UnitZ();
  ground.stiffness = params.at("k");
  ground.damping = params.at("c");
  ground.adhesive = adhesive;
  return ground;
}

Run point_over(const Ground& ground, const Json& params, double height) {
  return Run(network({{height * Vec3::UnitZ(), params.at("m")}}, {}),
             {.gravity = gravity_of(params), .air = {}, .ground = ground});
}

double height_of(const Run& run) { return run.lattice().motion[0].position.z(); }
double rise_of(const Run& run) { return run.lattice().motion[0].velocity.z(); }

struct Drop {
  double impact_time = 0.0, impact_speed = 0.0;  // s, m/s
  double penetration = 0.0;                      // m
  double contact_time = 0.0;                     // s
  double restitution = 0.0, rebound = 0.0;       // 0: it stays on the ground; m
};

void step_on_until(Run& run, const std::function<bool()>& happened, double dt) {
  while (!run.step_until(happened, dt)) {
  }
}

// A step that ends on the ground feels it in its last stages: the steps down to it are short.
void fall_to_the_ground(Run& run) {
  const double near = 1e-6 * height_of(run);  // m
  step_on_until(
      run, [&] { return height_of(run) <= near; }, 1e-3);
  step_on_until(
      run, [&] { return height_of(run) <= 0.0; }, -0.02 * near / rise_of(run));
}

Drop drop(const Json& params, bool adhesive) {
  const Ground ground = soft_ground(params, adhesive);
  Run run = point_over(ground, params, params.at("h"));
  const double time_scale = std::sqrt(params.at("m").get<double>() / ground.stiffness);
  Drop result;
  fall_to_the_ground(run);
  result.impact_time = run.time();
  result.impact_speed = -rise_of(run);
  bool left = false;
  const double gives_up = run.time() + 100.0 * time_scale;
  while (!left && run.time() < gives_up) {
    const auto leaves = [&] { return height_of(run) >= 0.0 && rise_of(run) > 0.0; };
    left = run.step_until(leaves, 1e-3 * time_scale);
    result.penetration = std::max(result.penetration, -height_of(run));
  }
  if (!left) return result;
  result.contact_time = run.time() - result.impact_time;
  result.restitution = rise_of(run) / result.impact_speed;
  step_on_until(
      run, [&] { return rise_of(run) <= 0.0; }, 1e-3);
  result.rebound = height_of(run);
  return result;
}

// Where it comes to rest: the same ground, damped critically.
double rest_penetration(const Json& params) {
  Ground ground = soft_ground(params, true);
  const double mass = params.at("m");
  ground.damping = 2.0 * std::sqrt(ground.stiffness * mass);
  Run run = point_over(ground, params, 0.0);
  const double time_scale = std::sqrt(mass / ground.stiffness);
  run.advance_to(60.0 * time_scale, 0.05 * time_scale);
  return -height_of(run);
}

Json point_drop(const Case& c) {
  const Drop overlap = drop(c.params, true), force = drop(c.params, false);
  return {{"impact_speed", overlap.impact_speed},
          {"time_to_impact", overlap.impact_time},
          {"max_penetration", overlap.penetration},
          {"restitution_overlap_law", overlap.restitution},
          {"restitution_force_law", force.restitution},
          {"contact_time_overlap_law", overlap.contact_time},
          {"rest_penetration", rest_penetration(c.params)},
          {"rebound_height_overlap_law", overlap.rebound},
          {"rebound_height_force_law", force.rebound}};
}

}  // namespace

Kinds drop_kinds() { return {{"point_drop", point_drop}}; }

}  // namespace limber::reference
