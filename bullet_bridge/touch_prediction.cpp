#include "bullet_bridge/touch_prediction.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
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
#include "bullet_bridge/piece_body.h"
#include "core/dynamics/free_rotation.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

struct Leaf {
  const btCollisionShape* shape;
  btTransform pose;  // in the body's frame
};

// Gaps that count as a touch, m.
constexpr double kSlop = 1e-3;
constexpr int kMostAdvances = 24;

// A body on its way through a tick.
struct Path {
  btTransform start;
  Vec3 velocity = Vec3::Zero(), angular_velocity = Vec3::Zero(), gravity = Vec3::Zero();
  double reach = 0.0;           // m, of its shape from its centre
  std::optional<Vec3> moments;  // kg m^2, of a proxy: its angular velocity turns with it

  btTransform at(double t) const {
    btTransform pose = start;
    pose.setOrigin(start.getOrigin() + to_bullet(Vec3(t * velocity + 0.5 * t * t * gravity)));
    if (angular_velocity.isZero(0.0)) return pose;
    Eigen::Quaterniond orientation = from_bullet(start.getRotation());
    Vec3 omega = angular_velocity;
    if (moments) {
      rotate_freely(orientation, omega, *moments, t);
    } else {
      orientation = turned(orientation, omega, t);
    }
    pose.setRotation(to_bullet(orientation));
    return pose;
  }
  Vec3 velocity_at(const Vec3& place, double t) const {
    const Vec3 centre = from_bullet(start.getOrigin()) + t * velocity + 0.5 * t * t * gravity;
    return velocity + t * gravity + angular_velocity.cross(place - centre);
  }
  // m/s, that turning may add to an approach along n.
  double swing(const Vec3& n) const {
    return (moments ? fastest_spin() : angular_velocity.cross(n).norm()) * reach;
  }
  // rad/s: 2 T = omega . I omega >= I_min omega^2, and T stays.
  double fastest_spin() const {
    if (!moments) return angular_velocity.norm();
    const Vec3 local = from_bullet(start.getRotation()).conjugate() * angular_velocity;
    return std::sqrt(local.cwiseAbs2().dot(*moments) / moments->minCoeff());
  }
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

double turning_speed(const btCollisionObject& object) {
  return largest_speed({.angular_velocity = motion_of(object).angular_velocity}, object);
}

double fall_within(const btCollisionObject& object, double dt, TickGravity gravity) {
  if (gravity == TickGravity::kGiven || !is_movable(object) || !object.isActive()) return 0.0;
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

// m, by which a box reaches farther along a unit direction than Bullet's query has it, which rounds
// its edges by the margin m: the corner of a box of half extents h is at sum h_i |d_i|, that of the
// rounded one at sum (h_i - m) |d_i| + m.
double sharpness(const Leaf& leaf, const btVector3& direction) {
  if (leaf.shape->getShapeType() != BOX_SHAPE_PROXYTYPE) return 0.0;
  const btVector3 d = (leaf.pose.getBasis().transpose() * direction).absolute();
  return leaf.shape->getMargin() * std::max(0.0, double{d.x() + d.y() + d.z()} - 1.0);
}

// The gap is that between the planes across the normal: no farther than the shapes are apart, and a
// bound for whatever moves.
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
  const btVector3& normal = result.m_normalOnBInWorld;
  const double gap = result.m_distance - sharpness(a, normal) - sharpness(b, normal);
  return Closest{gap, from_bullet(normal), from_bullet(result.m_pointInWorld)};
}

std::optional<Closest> closest(const Leaf& mine, const Leaf& other) {
  if (other.shape->getShapeType() == STATIC_PLANE_PROXYTYPE) return closest_to_plane(mine, other);
  return closest_convex(mine, other);
}

Path path_of(const btCollisionObject& object, TickGravity gravity) {
  Path path{.start = object.getWorldTransform(), .reach = reach_of(object), .moments = {}};
  if (object.isStaticObject()) return path;
  const auto [velocity, angular_velocity] = motion_of(object);
  path.velocity = velocity;
  path.angular_velocity = angular_velocity;
  const btRigidBody* body = btRigidBody::upcast(&object);
  if (!body) return path;
  const bool falls = gravity == TickGravity::kToCome && body->isActive() && is_movable(object);
  if (falls) path.gravity = from_bullet(body->getGravity());
  if (dynamic_cast<const PieceBody*>(body)) {
    path.moments = from_bullet(body->getInvInertiaDiagLocal()).cwiseInverse();
  }
  return path;
}

// m, that Bullet's query takes off the corners of a proxy's hull, which was made smaller by the
// margin that rounds it. A corner at (m, m, m) from the centre of a ball of radius m sticks out by
// (sqrt(3) - 1) m. Boxes are sharp here: see sharpness().
double blunting(const btCollisionShape& shape, bool proxy) {
  if (!proxy || shape.getShapeType() == BOX_SHAPE_PROXYTYPE) return 0.0;
  return (std::sqrt(3.0) - 1.0) * shape.getMargin();
}

// Two convex shapes on their ways.
struct Pair {
  const Leaf& mine;
  const Path& body;
  const Leaf& other;
  const Path& partner;

  // m, a gap that counts as a touch.
  double slop() const {
    return kSlop + blunting(*mine.shape, body.moments.has_value()) +
           blunting(*other.shape, partner.moments.has_value());
  }

  std::optional<Closest> closest_at(double t) const {
    return closest({mine.shape, body.at(t) * mine.pose}, {other.shape, partner.at(t) * other.pose});
  }
  double fastest() const {  // m/s, of any two of their points
    return (body.velocity - partner.velocity).norm() + body.fastest_spin() * body.reach +
           partner.fastest_spin() * partner.reach;
  }
  double approach(const Closest& c, double t) const {
    const Vec3 relative = body.velocity_at(c.at, t) - partner.velocity_at(c.at, t);
    return std::max(0.0, -relative.dot(c.normal));
  }
};

// A touch may begin at an edge, across its normal, and be one of faces at once: that of the first
// few millimetres of overlap counts as well.
double hardest_approach(const Pair& pair, const Closest& first, double t, double dt) {
  constexpr int kLooks = 2;
  constexpr double kWay = 0.004;  // m, between two looks
  double approach = pair.approach(first, t);
  const double speed = (pair.body.velocity - pair.partner.velocity).norm();
  for (int look = 1; look <= kLooks && speed > 0.0; ++look) {
    const double then = t + look * kWay / speed;
    if (then > dt) break;
    const std::optional<Closest> c = pair.closest_at(then);
    if (c && c->gap <= pair.slop()) approach = std::max(approach, pair.approach(*c, then));
  }
  return approach;
}

std::optional<PredictedTouch> first_touch(const Leaf& mine, const Path& body, const Leaf& other,
                                          const Path& partner, double dt) {
  const Pair pair{mine, body, other, partner};
  const double slop = pair.slop();
  PredictedTouch touch;
  for (int advance = 0; advance < kMostAdvances; ++advance) {
    const double t = touch.time;
    const std::optional<Closest> c = pair.closest_at(t);
    if (!c) {  // Bullet's iteration failed
      touch.closing_speed = pair.fastest();
      return touch;
    }
    if (advance == 0) touch.gap = c->gap;
    if (c->gap <= slop) {
      touch.closing_speed = hardest_approach(pair, *c, t, dt);
      return touch;
    }
    const Vec3 centres = body.velocity - partner.velocity + t * (body.gravity - partner.gravity);
    const double fastest = -centres.dot(c->normal) + body.swing(c->normal) +
                           partner.swing(c->normal) +
                           (body.gravity - partner.gravity).norm() * (dt - t);
    if (c->gap - slop > fastest * (dt - t)) return std::nullopt;
    touch.time += (c->gap - 0.5 * slop) / fastest;
  }
  touch.closing_speed = pair.fastest();
  return touch;
}

// All triangles of a concave shape that the body may meet.
class Triangles : public btTriangleCallback {
 public:
  Triangles(const btConcaveShape& shape, const Leaf& mine, const Path& body, const Path& partner,
            const btTransform& pose, double dt)
      : mine_(mine), body_(body), partner_(partner), pose_(pose), dt_(dt) {
    margin_ = shape.getMargin();
    btVector3 low, high;
    box_in_frame(low, high);
    shape.processAllTriangles(this, low, high);
  }
  std::optional<PredictedTouch> hardest;

  void processTriangle(btVector3* corners, int, int) override {
    btTriangleShape triangle(corners[0], corners[1], corners[2]);
    triangle.setMargin(margin_);
    keep_harder(hardest, first_touch(mine_, body_, {&triangle, pose_}, partner_, dt_));
  }

  static void keep_harder(std::optional<PredictedTouch>& kept,
                          const std::optional<PredictedTouch>& found) {
    if (found && (!kept || found->closing_speed > kept->closing_speed)) kept = found;
  }

 private:
  // Around the body's whole way, in the frame of the concave shape.
  void box_in_frame(btVector3& low, btVector3& high) const {
    const btTransform to_frame = (partner_.start * pose_).inverse();
    const btVector3 from = to_frame * body_.start.getOrigin();
    const btVector3 to = to_frame * body_.at(dt_).getOrigin();
    const Vec3 way = partner_.velocity * dt_;
    const auto around =
        static_cast<btScalar>(body_.reach + way.norm() +
                              partner_.fastest_spin() * dt_ * partner_.reach + kSlop + margin_);
    low = high = from;
    low.setMin(to);
    high.setMax(to);
    low -= btVector3(around, around, around);
    high += btVector3(around, around, around);
  }

  const Leaf& mine_;
  const Path& body_;
  const Path& partner_;
  const btTransform& pose_;
  double dt_;
  btScalar margin_ = 0;
};

std::optional<PredictedTouch> hardest_touch(const Leaf& mine, const Path& body, const Leaf& other,
                                            const Path& partner, double dt) {
  const bool plane = other.shape->getShapeType() == STATIC_PLANE_PROXYTYPE;
  if (plane || other.shape->isConvex()) return first_touch(mine, body, other, partner, dt);
  if (other.shape->isConcave()) {
    const auto& concave = static_cast<const btConcaveShape&>(*other.shape);
    return Triangles(concave, mine, body, partner, other.pose, dt).hardest;
  }
  return PredictedTouch{.closing_speed = Pair{mine, body, other, partner}.fastest()};
}

}  // namespace

double largest_closing_speed(const btRigidBody& body, double reach, const btCollisionObject& other,
                             double dt, TickGravity gravity) {
  const BodySpeeds own = motion_of(body), partner = motion_of(other);
  return (own.velocity - partner.velocity).norm() + own.angular_velocity.norm() * reach +
         fall_within(body, dt, gravity) + turning_speed(other) + fall_within(other, dt, gravity);
}

std::optional<PredictedTouch> predict_touch(const btRigidBody& body, const btCollisionObject& other,
                                            double dt, TickGravity gravity) {
  std::vector<Leaf> mine, others;
  collect_leaves(*body.getCollisionShape(), btTransform::getIdentity(), mine);
  collect_leaves(*other.getCollisionShape(), btTransform::getIdentity(), others);
  const Path path = path_of(body, gravity), partner = path_of(other, gravity);
  std::optional<PredictedTouch> hardest;
  for (const Leaf& m : mine) {
    for (const Leaf& o : others) {
      Triangles::keep_harder(hardest, hardest_touch(m, path, o, partner, dt));
    }
  }
  return hardest;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
