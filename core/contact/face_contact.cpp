#include "core/contact/face_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber {
namespace {

double mass_of_inverse(double inverse) {
  return inverse > 0.0 ? 1.0 / inverse : std::numeric_limits<double>::infinity();
}

}  // namespace

FaceForces& FaceForces::operator+=(const FaceForces& other) {
  on_point += other.on_point;
  for (int i = 0; i < 3; ++i) on_corners[i] += other.on_corners[i];
  return *this;
}

double separation_speed(const FaceContact& contact, const FaceMotion& motion) {
  return contact.normal.dot(motion.point - point_at(motion.corners, contact.weights));
}

double contact_mass(const FaceContact& contact, const FaceMobility& mobility) {
  double inverse = mobility.point;
  for (int i = 0; i < 3; ++i) {
    inverse += contact.weights[i] * contact.weights[i] * mobility.corners[i];
  }
  return mass_of_inverse(inverse);
}

FaceForces push_apart(const FaceContact& contact, double push) {
  FaceForces forces;
  forces.on_point = push * contact.normal;
  for (int i = 0; i < 3; ++i) {
    forces.on_corners[i] = -contact.weights[i] * forces.on_point;
  }
  return forces;
}

// The place's height above the point is the depth: where the triangle tilts, its continuation to
// the point moves across by depth times the gradient of the corners' speed along the normal.
Vec3 slip_velocity(const FaceContact& contact, const FaceMotion& motion,
                   const std::array<Vec3, 3>& gradients) {
  const Vec3 relative = motion.point - point_at(motion.corners, contact.weights);
  Vec3 slip = relative - relative.dot(contact.normal) * contact.normal;
  for (int i = 0; i < 3; ++i) {
    slip -= contact.depth * contact.normal.dot(motion.corners[i]) * gradients[i];
  }
  return slip;
}

FaceForces drag_across(const FaceContact& contact, const Vec3& force,
                       const std::array<Vec3, 3>& gradients) {
  FaceForces forces;
  forces.on_point = force;
  for (int i = 0; i < 3; ++i) {
    forces.on_corners[i] =
        -contact.weights[i] * force - contact.depth * force.dot(gradients[i]) * contact.normal;
  }
  return forces;
}

double slip_mass(const FaceContact& contact, const FaceMobility& mobility, const Vec3& direction,
                 const std::array<Vec3, 3>& gradients) {
  const FaceForces unit = drag_across(contact, direction, gradients);
  double inverse = mobility.point;
  for (int i = 0; i < 3; ++i) inverse += unit.on_corners[i].squaredNorm() * mobility.corners[i];
  return mass_of_inverse(inverse);
}

FaceForces friction_across(const FaceContact& contact, const FaceMotion& motion,
                           const FaceMobility& mobility, const std::array<Vec3, 3>& gradients,
                           double most, double dt) {
  const Vec3 slip = slip_velocity(contact, motion, gradients);
  const double speed = slip.norm();
  if (speed == 0.0) return {};
  const double mass = slip_mass(contact, mobility, slip / speed, gradients);
  return drag_across(contact, friction_force(1.0, most, mass, slip, dt), gradients);
}

}  // namespace limber
