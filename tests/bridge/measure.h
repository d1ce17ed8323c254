#pragma once

#include <btBulletDynamicsCommon.h>

#include "bullet_bridge/conversions.h"
#include "core/model/physical_model.h"

// Sums over points and bodies, independent of the library's own (core/dynamics/rigid_motion.h).

namespace limber::bullet::test {

struct Sums {
  double mass = 0.0;                     // kg
  Vec3 moment = Vec3::Zero();            // sum m x, kg m
  Vec3 momentum = Vec3::Zero();          // kg m/s
  Vec3 angular_momentum = Vec3::Zero();  // about the origin, kg m^2/s
  double kinetic = 0.0;                  // J
  double elastic = 0.0;                  // J

  Vec3 centre() const { return moment / mass; }
  Vec3 velocity() const { return momentum / mass; }
  double energy(double gravity) const { return kinetic + elastic + gravity * moment.y(); }

  void add_point(double m, const Vec3& x, const Vec3& v) {
    mass += m;
    moment += m * x;
    momentum += m * v;
    angular_momentum += m * x.cross(v);
    kinetic += 0.5 * m * v.squaredNorm();
  }
  Sums& operator+=(const Sums& other) {
    mass += other.mass;
    moment += other.moment;
    momentum += other.momentum;
    angular_momentum += other.angular_momentum;
    kinetic += other.kinetic;
    elastic += other.elastic;
    return *this;
  }
};

inline Sums sums_of(const PhysicalModel& model) {
  Sums sums;
  for (PointId p : ids_of(model.points)) {
    sums.add_point(model.points[p].mass, model.geometry.points[p], model.points[p].velocity);
  }
  for (EdgeId e : ids_of(model.edges)) {
    const EdgeAttributes& edge = model.edges[e];
    if (edge.broken) continue;
    const auto [a, b] = model.geometry.edges[e];
    const double stretch =
        (model.geometry.points[b] - model.geometry.points[a]).norm() - edge.rest_length;
    sums.elastic += 0.5 * edge.stiffness * stretch * stretch;
  }
  return sums;
}

inline Sums sums_of(const btRigidBody& body) {
  Sums sums;
  const double mass = 1.0 / body.getInvMass();
  sums.add_point(mass, from_bullet(body.getWorldTransform().getOrigin()),
                 from_bullet(body.getLinearVelocity()));
  const Mat3 rotation = from_bullet(body.getWorldTransform().getRotation()).toRotationMatrix();
  const Vec3 moments = from_bullet(body.getInvInertiaDiagLocal()).cwiseInverse();
  const Vec3 omega = from_bullet(body.getAngularVelocity());
  const Vec3 spin = rotation * moments.cwiseProduct(rotation.transpose() * omega);
  sums.angular_momentum += spin;
  sums.kinetic += 0.5 * omega.dot(spin);
  return sums;
}

inline double lowest_point(const PhysicalModel& model) {
  double low = 1e300;
  for (const Vec3& x : model.geometry.points) low = std::min(low, x.y());
  return low;
}

}  // namespace limber::bullet::test
