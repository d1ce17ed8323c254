#pragma once

#include "core/model/physical_model.h"

namespace limber {

struct EquilibriumSettings {
  double tolerance = 1e-13;  // largest remaining force / largest force that has to balance
  int most_iterations = 3000;
};

struct Equilibrium {
  bool converged = false;  // forces balance as far as the positions' digits let them, and stably
  int iterations = 0;
  double residual_N = 0.0;  // largest remaining force on a free point
};

// Moves the free points (not pinned, with an edge) of the model to a stable equilibrium near where
// they are: a minimum of elastic plus gravitational energy, by Newton's method with the exact
// tangent stiffness (where that is not positive definite, without the part of compressed springs).
// Where forces balance in an unstable equilibrium (a strut that should buckle) it leaves that in
// the direction of most negative stiffness. Without gravity a piece that no pin holds keeps its
// place as a whole. Velocities become zero. Throws InputError when gravity acts on a piece that no
// pin holds.
Equilibrium settle(PhysicalModel& model, const Vec3& gravity_m_s2,
                   const EquilibriumSettings& settings = {});

// Small displacements of all points by gravity in the linear theory about where the model is (the
// unloaded state), m: K u = m g, the limit of settle() for weak gravity. Throws InputError when the
// pins do not hold the model.
IdVector<PointId, Vec3> linear_sag(const PhysicalModel& model, const Vec3& gravity_m_s2);

// What holds each pinned point in its place against its springs and gravity, N; zero for others.
IdVector<PointId, Vec3> support_forces(const PhysicalModel& model, const Vec3& gravity_m_s2);

}  // namespace limber
