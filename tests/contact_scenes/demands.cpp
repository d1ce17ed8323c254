#include "tests/contact_scenes/demands.h"

#include <algorithm>
#include <cmath>

#include "bullet_bridge/conversions.h"
#include "tests/bridge/measure.h"
#include "tests/bridge/world.h"
#include "tests/contact_scenes/shapes.h"

namespace limber::bullet::test {

RigidSpec ground() { return {.shape = box({20.0, 1.0, 20.0}), .position = {0.0, -0.5, 0.0}}; }

double lowest(const btRigidBody& body) {
  btVector3 low, high;
  body.getCollisionShape()->getAabb(body.getWorldTransform(), low, high);
  return low.y();
}

double highest(const PhysicalModel& model) {
  double high = -kNoLimit;
  for (const Vec3& x : model.geometry.points) high = std::max(high, x.y());
  return high;
}

Vec3 centre_of(const btRigidBody& body) {
  return from_bullet(body.getWorldTransform().getOrigin());
}

bool is_broken(const PhysicalModel& model) {
  return std::any_of(model.edges.begin(), model.edges.end(),
                     [](const EdgeAttributes& edge) { return edge.broken; });
}

Demand stays_above_ground(std::size_t rigid) {
  return {.what = "rigid in floor mm", .most = 1e3 * kSlack, .value = [=](const SceneState& state) {
            return -1e3 * lowest(*state.rigid[rigid]);
          }};
}

Demand lattice_stays_above_ground(std::size_t flexible, double spacing) {
  return {.what = "lattice below floor mm",
          .most = 0.5e3 * spacing,
          .value = [=](const SceneState& state) {
            return -1e3 * lowest_point(state.flexible[flexible]);
          }};
}

Demand is_not_thrown_up(std::size_t rigid, double start_height) {
  return {.what = "thrown up mm", .most = 1e3 * kSlack, .value = [=](const SceneState& state) {
            return 1e3 * (centre_of(*state.rigid[rigid]).y() - start_height);
          }};
}

Demand does_not_pass_sheet(std::size_t rigid, std::size_t flexible) {
  return {.what = "passed unbroken, m", .most = 0.0, .value = [=](const SceneState& state) {
            const PhysicalModel& sheet = state.flexible[flexible];
            if (is_broken(sheet)) return 0.0;
            return lowest_point(sheet) - centre_of(*state.rigid[rigid]).y();
          }};
}

Demand is_slowed(std::size_t rigid, double start_speed, double start_height) {
  return {.what = "speed kept %",
          .most = 99.0,
          .when = Demand::When::kAtEnd,
          .value = [=](const SceneState& state) {
            const btRigidBody& body = *state.rigid[rigid];
            const double fallen = std::max(0.0, start_height - centre_of(body).y());
            const double free = std::sqrt(start_speed * start_speed + 2.0 * kGravity * fallen);
            return 100.0 * from_bullet(body.getLinearVelocity()).norm() / free;
          }};
}

}  // namespace limber::bullet::test
