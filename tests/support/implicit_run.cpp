#include "tests/support/implicit_run.h"

namespace limber::test {

void take_forces(Lattice& lattice, const Vec3& gravity_m_s2) {
  for (std::int32_t p : lattice.dynamic_points) lattice.force[p] = lattice.mass[p] * gravity_m_s2;
  for (const Spring& s : lattice.active) {
    const Vec3 d = lattice.motion[s.b].position - lattice.motion[s.a].position;
    const Vec3 w = lattice.motion[s.b].velocity - lattice.motion[s.a].velocity;
    if (d.norm() == 0.0) continue;
    const Vec3 n = d / d.norm();
    const Vec3 pull = (s.stiffness * (d.norm() - s.rest_length) + s.damping * w.dot(n)) * n;
    lattice.force[s.a] += pull;
    lattice.force[s.b] -= pull;
  }
}

ImplicitReport run_implicit(Lattice& lattice, int steps, double dt,
                            const ImplicitSettings& settings, const Vec3& gravity_m_s2) {
  ImplicitEuler euler(settings);
  ImplicitReport report;
  for (int n = 0; n < steps; ++n) {
    take_forces(lattice, gravity_m_s2);
    report = euler.step(lattice, lattice.dynamic_points, dt);
  }
  return report;
}

}  // namespace limber::test
