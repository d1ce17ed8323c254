#include "bullet_bridge/touch_prediction.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bullet_bridge/body_motion.h"
#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

struct Leaf {
  const btCollisionShape* shape;
  btTransform pose;  // world
};

struct Closest {
  double gap;   // m
  Vec3 normal;  // unit, from the other body to this one
  Vec3 at;      // world, on the other body
};

void collect_leaves(const btCollisionShape& shape, const btTransform& pose,
                    std::vector<Leaf>& leaves) {
  if (!shape.isCompound()) {
    leaves.push_back({&shape, pose});
    return;
  }
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    collect_leaves(*compound.getChildShape(i), pose * compound.getChildTransform(i), leaves);
  }
}

Vec3 velocity_at(const btCollisionObject& object, const Vec3& at) {
  const BodyMotion motion = motion_of(object);
  const Vec3 arm = at - from_bullet(object.getWorldTransform().getOrigin());
  return motion.velocity + motion.angular_velocity.cross(arm);
}

double turning_speed(const btCollisionObject& object) {
  return largest_speed({.angular_velocity = motion_of(object).angular_velocity}, object);
}

double fall_within(const btCollisionObject& object, double dt) {
  if (!is_movable(object) || !object.isActive()) return 0.0;
  return btRigidBody::upcast(&object)->getGravity().length() * dt;
}

Closest closest_to_plane(const Leaf& convex, const Leaf& plane_leaf) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(*plane_leaf.shape);
  const Vec3 normal = from_bullet(plane_leaf.pose.getBasis() * plane.getPlaneNormal());
  const btVector3 down = convex.pose.getBasis().transpose() * to_bullet(Vec3(-normal));
  const auto& shape = static_cast<const btConvexShape&>(*convex.shape);
  const Vec3 lowest = from_bullet(convex.pose * shape.localGetSupportingVertex(down));
  const double offset =
      plane.getPlaneConstant() + normal.dot(from_bullet(plane_leaf.pose.getOrigin()));
  const double gap = normal.dot(lowest) - offset;
  return {gap, normal, lowest - gap * normal};
}

std::optional<Closest> closest_convex(const Leaf& a, const Leaf& b) {
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btGjkPairDetector detector(static_cast<const btConvexShape*>(a.shape),
                             static_cast<const btConvexShape*>(b.shape), &simplex, &depth);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = a.pose;
  input.m_transformB = b.pose;
  btPointCollector result;
  detector.getClosestPoints(input, result, nullptr);
  if (!result.m_hasResult) return std::nullopt;
  return Closest{result.m_distance, from_bullet(result.m_normalOnBInWorld),
                 from_bullet(result.m_pointInWorld)};
}

std::optional<Closest> closest(const Leaf& mine, const Leaf& other) {
  if (other.shape->getShapeType() == STATIC_PLANE_PROXYTYPE) return closest_to_plane(mine, other);
  if (other.shape->isConvex()) return closest_convex(mine, other);
  return std::nullopt;
}

// Speed after falling through the gap, m/s: a body that rests has none, whatever gravity gives it
// before the solver takes it back.
double speed_at_contact(double approach, double gap, const btRigidBody& body) {
  if (approach <= 0.0) return 0.0;
  const double fall = 2.0 * body.getGravity().length() * std::max(0.0, gap);
  return std::sqrt(approach * approach + fall);
}

}  // namespace

double largest_closing_speed(const btCollisionObject& a, const btCollisionObject& b, double dt) {
  const Vec3 relative = motion_of(a).velocity - motion_of(b).velocity;
  return relative.norm() + turning_speed(a) + turning_speed(b) + fall_within(a, dt) +
         fall_within(b, dt);
}

std::optional<PredictedTouch> predict_touch(const btRigidBody& body, const btCollisionObject& other,
                                            double dt) {
  std::vector<Leaf> mine, others;
  collect_leaves(*body.getCollisionShape(), body.getWorldTransform(), mine);
  collect_leaves(*other.getCollisionShape(), other.getWorldTransform(), others);
  const double fastest = largest_closing_speed(body, other, dt);
  std::optional<PredictedTouch> worst;
  const auto take = [&](double gap, double speed) {
    if (!worst || speed > worst->closing_speed) worst = PredictedTouch{gap, speed};
  };
  for (const Leaf& m : mine) {
    for (const Leaf& o : others) {
      if (!o.shape->isConvex() && o.shape->getShapeType() != STATIC_PLANE_PROXYTYPE) {
        take(0.0, fastest);
        continue;
      }
      const std::optional<Closest> c = closest(m, o);
      if (!c) continue;
      const Vec3 relative = velocity_at(body, c->at) - velocity_at(other, c->at);
      const double approach = -relative.dot(c->normal);
      const double swing = turning_speed(body) + turning_speed(other);
      const double reach = (approach + swing + fall_within(body, dt)) * dt;
      if (c->gap <= reach) take(c->gap, speed_at_contact(approach, c->gap, body));
    }
  }
  return worst;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
