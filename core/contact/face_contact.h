#pragma once

#include <array>

#include "core/contact/penalty.h"
#include "core/contact/triangle.h"

namespace limber {

// What a force on a point and, opposite, on the corners of a triangle does at each of them. Sums of
// forces and of moments are zero, whatever the triangle's shape.
struct FaceForces {
  Vec3 on_point = Vec3::Zero();  // N
  std::array<Vec3, 3> on_corners = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

  FaceForces& operator+=(const FaceForces& other);
};

// A point against the place of a triangle with these weights.
struct FaceContact {
  Vec3 normal = Vec3::Zero();   // unit, the way the point is pushed
  Vec3 weights = Vec3::Zero();  // of the place
  double depth = 0.0;           // m, from the point along the normal to the place
};

// Velocities of the point and the corners, m/s; and their inverse masses, 1/kg, each times the
// number of contacts that share it.
struct FaceMotion {
  Vec3 point;
  std::array<Vec3, 3> corners;
};
struct FaceMobility {
  double point;
  std::array<double, 3> corners;
};

// Speed at which the depth shrinks, m/s.
double separation_speed(const FaceContact& contact, const FaceMotion& motion);

// Effective mass along the normal, kg: 1 / (1/m_p + sum w_i^2 / m_i). With mobilities n_a / m_a of
// points that n_a contacts share, springs of omega^2 times this mass stay below the frequency omega
// together: k (g . v)^2 <= k (sum g_a^2 n_a / m_a) (sum m_a v_a^2 / n_a) for each (Cauchy), and the
// last sums of all contacts are at most sum m v^2. Infinite where nothing can move.
double contact_mass(const FaceContact& contact, const FaceMobility& mobility);

// A push along the normal, N, on the point; its reaction at the place.
FaceForces push_apart(const FaceContact& contact, double push);

// How the point moves across the normal relative to the triangle's rigid continuation to the point,
// m/s. `gradients` of the triangle's weights.
Vec3 slip_velocity(const FaceContact& contact, const FaceMotion& motion,
                   const std::array<Vec3, 3>& gradients);

// A force across the normal, N, on the point. It and its reaction at the place, a depth apart, are
// a couple; forces along the normal on the corners, whose sum is zero, take it back: the power is
// force . slip_velocity().
FaceForces drag_across(const FaceContact& contact, const Vec3& force,
                       const std::array<Vec3, 3>& gradients);

// Effective mass against forces in this direction across the normal (unit), kg.
double slip_mass(const FaceContact& contact, const FaceMobility& mobility, const Vec3& direction,
                 const std::array<Vec3, 3>& gradients);

// Coulomb friction of at most `most` N, against the slip, as friction_force() of penalty.h has it.
FaceForces friction_across(const FaceContact& contact, const FaceMotion& motion,
                           const FaceMobility& mobility, const std::array<Vec3, 3>& gradients,
                           double most, double dt);

}  // namespace limber
