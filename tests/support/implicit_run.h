#pragma once

#include "core/dynamics/implicit_euler.h"

namespace limber::test {

// Backward Euler as the textbooks have it: one Newton iteration, no parts, no spin restored.
inline constexpr ImplicitSettings kTextbook{.most_newton_iterations = 1,
                                            .most_halvings = 0,
                                            .solver_tolerance = 1e-13,
                                            .restore_spin = false};

// lattice.force by the definitions of weight, spring and damper, for dynamic points.
void take_forces(Lattice& lattice, const Vec3& gravity_m_s2 = Vec3::Zero());

// Steps all dynamic points, under fresh forces each time. Returns the last step's report.
ImplicitReport run_implicit(Lattice& lattice, int steps, double dt,
                            const ImplicitSettings& settings = {},
                            const Vec3& gravity_m_s2 = Vec3::Zero());

}  // namespace limber::test
