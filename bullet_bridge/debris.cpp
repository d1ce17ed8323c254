#include "bullet_bridge/debris.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/lattice_shape.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// A particle that hits an immovable body slower than this rests there, m/s: one tick of gravity at
// 1/60 s makes 0.16.
constexpr double kRestSpeed = 0.2;
// It is put this far off the surface, m, so that its next ray starts outside.
constexpr double kLift = 1e-4;

struct FirstHit : btCollisionWorld::ClosestRayResultCallback {
  FirstHit(const btVector3& from, const btVector3& to,
           const std::unordered_set<const btCollisionObject*>& ignored_bodies)
      : ClosestRayResultCallback(from, to), ignored(ignored_bodies) {}

  bool needsCollision(btBroadphaseProxy* proxy) const override {
    const auto* object = static_cast<const btCollisionObject*>(proxy->m_clientObject);
    return object->hasContactResponse() && !stands_for_lattice(*object) &&
           !ignored.contains(object) && ClosestRayResultCallback::needsCollision(proxy);
  }

  const std::unordered_set<const btCollisionObject*>& ignored;
};

Vec3 velocity_after_hit(const Vec3& relative, const Vec3& normal, double friction) {
  const double approach = -relative.dot(normal);
  const Vec3 slip = relative + approach * normal;
  const double speed = slip.norm();
  if (speed == 0.0) return Vec3::Zero();
  return slip * std::max(0.0, 1.0 - friction * approach / speed);
}

}  // namespace

void Debris::forget(IdRange<PointId> points) {
  std::erase_if(points_, [&](const Particle& particle) {
    return particle.point >= points.begin && particle.point < points.end;
  });
}

double Debris::step(btDiscreteDynamicsWorld& world, Lattice& lattice,
                    const std::unordered_set<const btCollisionObject*>& ignored, double dt,
                    double lifetime) {
  double retired = 0.0;
  for (Particle& particle : points_) {
    if (particle.age == 0.0) lift_out(particle, world, lattice, ignored);
    if (!particle.resting) move(particle, world, lattice, ignored, dt);
    particle.age += dt;
    if (particle.age <= lifetime) continue;
    lattice.motion[particle.point].velocity.setZero();
    retired += lattice.mass[particle.point];
  }
  std::erase_if(points_, [&](const Particle& particle) { return particle.age > lifetime; });
  return retired;
}

// Impacts press points into what they hit, and some break off there: a ray from inside finds
// nothing, and the particle would fall for ever. On the straight line from the middle of the piece
// that it came off to where it is, its way into a body nearby is the surface it was pressed into.
void Debris::lift_out(const Particle& particle, btDiscreteDynamicsWorld& world, Lattice& lattice,
                      const std::unordered_set<const btCollisionObject*>& ignored) const {
  constexpr double kDeepest = 4.0;  // contact radii: what is farther lies between them, not around
  PointMotion& point = lattice.motion[particle.point];
  if (particle.born_in == point.position) return;
  FirstHit hit(to_bullet(particle.born_in), to_bullet(point.position), ignored);
  world.rayTest(hit.m_rayFromWorld, hit.m_rayToWorld, hit);
  if (!hit.hasHit()) return;
  const Vec3 surface = from_bullet(hit.m_hitPointWorld);
  const double depth = (point.position - surface).norm();
  if (depth > kDeepest * lattice.contact_radius[particle.point]) return;
  point.position = surface + kLift * from_bullet(hit.m_hitNormalWorld).normalized();
}

void Debris::move(Particle& particle, btDiscreteDynamicsWorld& world, Lattice& lattice,
                  const std::unordered_set<const btCollisionObject*>& ignored, double dt) const {
  const Vec3 gravity = from_bullet(world.getGravity());
  PointMotion& point = lattice.motion[particle.point];
  const Vec3 velocity = point.velocity + gravity * dt;
  const Vec3 target = point.position + 0.5 * dt * (point.velocity + velocity);
  FirstHit hit(to_bullet(point.position), to_bullet(target), ignored);
  world.rayTest(hit.m_rayFromWorld, hit.m_rayToWorld, hit);
  if (!hit.hasHit()) {
    point = {target, velocity};
    return;
  }
  const Vec3 normal = from_bullet(hit.m_hitNormalWorld).normalized();
  auto* body = const_cast<btRigidBody*>(btRigidBody::upcast(hit.m_collisionObject));
  const bool movable = body && !body->isStaticOrKinematicObject();
  Vec3 ground = Vec3::Zero();
  Vec3 arm = Vec3::Zero();
  if (body) {
    arm = from_bullet(hit.m_hitPointWorld - body->getCenterOfMassPosition());
    ground = from_bullet(body->getVelocityInLocalPoint(to_bullet(arm)));
  }
  const double friction =
      hit.m_collisionObject->getFriction() *
      lattice.objects[lattice.point_object[particle.point]].authored.object.friction;
  const Vec3 after = ground + velocity_after_hit(velocity - ground, normal, friction);
  if (movable) {
    body->activate();
    body->applyImpulse(to_bullet(lattice.mass[particle.point] * (velocity - after)),
                       to_bullet(arm));
  }
  particle.resting = !movable && after.norm() < kRestSpeed;
  point = {from_bullet(hit.m_hitPointWorld) + kLift * normal,
           particle.resting ? Vec3(Vec3::Zero()) : after};
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
