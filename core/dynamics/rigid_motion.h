#pragma once

#include <span>
#include <vector>

#include "core/model/vec3.h"

namespace limber {

struct PointMotion {
  Vec3 position;  // m
  Vec3 velocity;  // m/s
};

// What a set of mass points is as a rigid body. World frame, about the centre of mass.
struct RigidMotion {
  double mass = 0.0;                     // kg
  Vec3 centre = Vec3::Zero();            // m
  Vec3 velocity = Vec3::Zero();          // P / M, m/s
  Vec3 angular_momentum = Vec3::Zero();  // about the centre, kg m^2/s
  Mat3 inertia = Mat3::Zero();           // about the centre, kg m^2
  Vec3 angular_velocity = Vec3::Zero();  // I^-1 L, rad/s; no spin about an axis without inertia

  Vec3 momentum() const { return mass * velocity; }
  double kinetic_energy() const;  // of the rigid motion alone, J
  Vec3 velocity_at(const Vec3& position) const;
};

// Sums over the points `of`. Angular velocity by the pseudo-inverse of the inertia: a straight line
// of points has none about itself, and carries no angular momentum there either.
RigidMotion rigid_motion(std::span<const PointMotion> motion, std::span<const double> mass,
                         std::span<const std::int32_t> of);

// I^-1 L; moments below `least_share` of the largest count as none, and carry no spin.
Vec3 angular_velocity_of(const Mat3& inertia, const Vec3& angular_momentum,
                         double least_share = 1e-12);

// Kinetic energy of the same points, J.
double kinetic_energy(std::span<const PointMotion> motion, std::span<const double> mass,
                      std::span<const std::int32_t> of);

// The proper rotation that best maps `reference` onto the present positions, both about their
// centres of mass: polar decomposition of sum m x r^T by a determinant-corrected SVD (Kabsch 1976).
Mat3 best_rotation(std::span<const PointMotion> motion, std::span<const Vec3> reference,
                   std::span<const double> mass, std::span<const std::int32_t> of);

// How well a rigid shape stands for a set of points.
struct RigidFit {
  Mat3 rotation = Mat3::Identity();  // best_rotation()
  // Singular values of sum m x r^T, kg m^2, descending; the last one has the sign of the
  // determinant. < 0: the points are turned inside out; 0: they, or the reference, are flat. The
  // best rotation is unique as long as the last two do not add up to 0.
  Vec3 singular_values = Vec3::Zero();
  double residual = 0.0;  // m: mass-weighted root mean square of x - R r, about the centres
};
RigidFit rigid_fit(std::span<const PointMotion> motion, std::span<const Vec3> reference,
                   std::span<const double> mass, std::span<const std::int32_t> of);

}  // namespace limber
