#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/environment/face_forces.h"

namespace limber {

// A rigid body that flies, in the frame of its principal axes, about its centre of mass.
struct FlyingBody {
  double mass = 0.0;            // kg
  Vec3 moments = Vec3::Ones();  // kg m^2, > 0
  std::vector<BodyFace> faces = {};  // that feel the air
};

struct FlightState {
  Vec3 centre = Vec3::Zero();                                       // m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // body to world
  Vec3 velocity = Vec3::Zero();                                     // m/s
  Vec3 angular_momentum = Vec3::Zero();                             // world, kg m^2/s
};

Vec3 angular_velocity(const FlyingBody& body, const FlightState& state);  // world, rad/s

// The body's motion over dt (s) under gravity and the air, which is what a lattice of its faces
// would do if it did not bend: m v' = m g + F, L' = T, by classical Runge-Kutta steps short enough
// for its rotation (a twentieth of a radian) and for the drag (half of what slows it down by 1/e).
FlightState flown(const FlyingBody& body, const Air& air, const Vec3& gravity, double time,
                  double dt, const FlightState& start);

}  // namespace limber
