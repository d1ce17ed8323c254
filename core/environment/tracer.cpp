#include "core/environment/tracer.h"

namespace limber {

Vec3 drifted(const FlowField& field, const Vec3& at, double time, double dt) {
  const double middle = time + 0.5 * dt;
  const Vec3 k1 = flow_velocity(field, at, time);
  const Vec3 k2 = flow_velocity(field, at + 0.5 * dt * k1, middle);
  const Vec3 k3 = flow_velocity(field, at + 0.5 * dt * k2, middle);
  const Vec3 k4 = flow_velocity(field, at + dt * k3, time + dt);
  return at + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

}  // namespace limber
