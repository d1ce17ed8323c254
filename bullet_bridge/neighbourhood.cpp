#include "bullet_bridge/neighbourhood.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bullet_bridge/body_motion.h"
#include "bullet_bridge/conversions.h"
#include "bullet_bridge/lattice_shape.h"
#include "bullet_bridge/shadow_body.h"
#include "bullet_bridge/shapes/contact_shape.h"
#include "bullet_bridge/touch_prediction.h"
#include "core/model/bounds.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

constexpr double kReachMargin = 0.01;  // m, beyond the way at the present speed
constexpr std::size_t kMostSamples = 300;

struct Collector : btBroadphaseAabbCallback {
  std::vector<const btCollisionObject*> found;
  bool process(const btBroadphaseProxy* proxy) override {
    const auto* object = static_cast<const btCollisionObject*>(proxy->m_clientObject);
    if (is_met(*object)) found.push_back(object);
    return true;
  }
};

struct Bounds {
  Vec3 low = Vec3::Constant(1e30), high = Vec3::Constant(-1e30);
  double fastest = 0.0;         // m/s
  double largest_radius = 0.0;  // m

  bool contains(const Vec3& p, double margin) const {
    return (p.array() >= low.array() - margin).all() && (p.array() <= high.array() + margin).all();
  }
};

Bounds bounds_of(const Lattice& lattice, std::span<const std::int32_t> points) {
  Bounds b;
  for (std::int32_t p : points) {
    b.low = b.low.cwiseMin(lattice.motion[p].position);
    b.high = b.high.cwiseMax(lattice.motion[p].position);
    b.fastest = std::max(b.fastest, lattice.motion[p].velocity.squaredNorm());
    b.largest_radius = std::max(b.largest_radius, lattice.contact_radius[p]);
  }
  b.fastest = std::sqrt(b.fastest);
  return b;
}

// The points inside the other piece's bounds, thinned to a few hundred.
std::vector<std::int32_t> points_near(const Lattice& lattice, std::span<const std::int32_t> points,
                                      const Bounds& other, double margin) {
  std::vector<std::int32_t> inside;
  for (std::int32_t p : points) {
    if (other.contains(lattice.motion[p].position, margin)) inside.push_back(p);
  }
  const std::size_t stride = 1 + inside.size() / kMostSamples;
  std::vector<std::int32_t> some;
  for (std::size_t i = 0; i < inside.size(); i += stride) some.push_back(inside[i]);
  return some;
}

// The points on their way through the tick, in the frame of the other body.
std::vector<PointMotion> seen_from(const btCollisionObject& other, const btCollisionObject& body,
                                   std::span<const Vec3> local, int looks, double dt) {
  ShadowBody mine = make_shadow(body), partner = make_shadow(other);
  std::vector<PointMotion> seen;
  for (int look = 0; look < looks; ++look) {
    advance_pose(mine, dt / looks);
    advance_pose(partner, dt / looks);
    const Mat3 to_frame = partner.rotation.transpose();
    for (const Vec3& r : local) {
      const Vec3 arm = mine.rotation * r;
      const Vec3 at = mine.position + arm - partner.position;
      const Vec3 velocity = mine.velocity + mine.angular_velocity.cross(arm) - partner.velocity -
                            partner.angular_velocity.cross(at);
      seen.push_back({to_frame * at, to_frame * velocity});
    }
  }
  return seen;
}

// Those that lie within `way` (m) of the other body's bounds: the rest cannot get there. Of what
// rests on a floor that is its lowest layer.
std::vector<Vec3> points_within(double way, const btCollisionObject& other,
                                const btCollisionObject& body, std::span<const Vec3> local) {
  btVector3 low, high;
  other.getCollisionShape()->getAabb(other.getWorldTransform(), low, high);
  const Vec3 from = from_bullet(low).array() - way, to = from_bullet(high).array() + way;
  const Vec3 centre = from_bullet(body.getWorldTransform().getOrigin());
  const Mat3 rotation = from_bullet(body.getWorldTransform().getRotation()).toRotationMatrix();
  std::vector<Vec3> within;
  for (const Vec3& r : local) {
    const Vec3 at = centre + rotation * r;
    if ((at.array() >= from.array()).all() && (at.array() <= to.array()).all()) within.push_back(r);
  }
  return within;
}

Box3 box_around(std::span<const PointMotion> seen) {
  Box3 box;
  for (const PointMotion& point : seen) box.extend(point.position);
  return box;
}

}  // namespace

std::vector<NearBody> sweeping_bodies(const btCollisionWorld& world, double dt) {
  std::vector<NearBody> sweeping;
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) {
    const btCollisionObject& object = *objects[i];
    // Most bodies move, sleep or stand: the fewest looks for them.
    if (btRigidBody::upcast(&object) && !object.isKinematicObject()) continue;
    if (object.isStaticObject() || !is_met(object)) continue;
    const double way = largest_speed(motion_of(object), object) * dt;
    if (way == 0.0) continue;
    btVector3 low, high;
    object.getCollisionShape()->getAabb(object.getWorldTransform(), low, high);
    const Vec3 around = Vec3::Constant(way);
    sweeping.push_back({&object, from_bullet(low) - around, from_bullet(high) + around});
  }
  return sweeping;
}

std::vector<const btCollisionObject*> bodies_in(btCollisionWorld& world, const Vec3& low,
                                                const Vec3& high) {
  Collector collector;
  world.getBroadphase()->aabbTest(to_bullet(low), to_bullet(high), collector);
  return std::move(collector.found);
}

bool is_met(const btCollisionObject& object) {
  const int type = object.getInternalType();
  const bool body = type == btCollisionObject::CO_RIGID_BODY ||
                    type == btCollisionObject::CO_COLLISION_OBJECT ||
                    type == btCollisionObject::CO_FEATHERSTONE_LINK;
  return body && object.hasContactResponse() && !stands_for_lattice(object);
}

bool may_meet(btCollisionWorld& world, const btCollisionObject& a, const btCollisionObject& b) {
  const auto handle = [](const btCollisionObject& object) {
    return const_cast<btBroadphaseProxy*>(object.getBroadphaseHandle());
  };
  return world.getPairCache()->needsBroadphaseCollision(handle(a), handle(b));
}

std::vector<NearBody> bodies_within_reach(btCollisionWorld& world,
                                          std::span<const NearBody> sweeping,
                                          const Lattice& lattice,
                                          std::span<const std::int32_t> points, double dt) {
  const Bounds bounds = bounds_of(lattice, points);
  const Vec3 reach = Vec3::Constant(1.5 * bounds.fastest * dt + kReachMargin);
  const Vec3 low = bounds.low - reach, high = bounds.high + reach;
  std::vector<NearBody> near;
  for (const btCollisionObject* object : bodies_in(world, low, high)) {
    near.push_back({object, low, high});
  }
  for (const NearBody& mover : sweeping) {
    const bool apart =
        (mover.low.array() > high.array()).any() || (mover.high.array() < low.array()).any();
    if (!apart) near.push_back({mover.object, low, high});
  }
  return merged(std::move(near));
}

std::vector<NearBody> merged(std::vector<NearBody> near) {
  std::stable_sort(near.begin(), near.end(), [](const NearBody& a, const NearBody& b) {
    return a.object->getWorldArrayIndex() < b.object->getWorldArrayIndex();
  });
  std::vector<NearBody> once;
  for (const NearBody& body : near) {
    if (once.empty() || once.back().object != body.object) {
      once.push_back(body);
    } else {
      once.back().low = once.back().low.cwiseMin(body.low);
      once.back().high = once.back().high.cwiseMax(body.high);
    }
  }
  return once;
}

double closing_speed(const Lattice& lattice, std::span<const std::int32_t> one,
                     std::span<const std::int32_t> other, double dt) {
  const Bounds bounds_one = bounds_of(lattice, one), bounds_other = bounds_of(lattice, other);
  // A piece's points are the corners of its cells: another's may pass between them by a spacing.
  const double touch = 2.0 * (bounds_one.largest_radius + bounds_other.largest_radius);
  const double margin = (bounds_one.fastest + bounds_other.fastest) * dt + touch;
  const std::vector<std::int32_t> mine = points_near(lattice, one, bounds_other, margin);
  const std::vector<std::int32_t> others = points_near(lattice, other, bounds_one, margin);
  double fastest = 0.0;
  for (std::int32_t p : mine) {
    for (std::int32_t q : others) {
      const Vec3 d = lattice.motion[q].position - lattice.motion[p].position;
      const Vec3 w = lattice.motion[q].velocity - lattice.motion[p].velocity;
      const double squared = d.squaredNorm();
      if (squared > margin * margin) continue;
      const double distance = std::sqrt(squared);
      const double closing = distance > 0.0 ? -w.dot(d) / distance : w.norm();
      if (distance - touch <= closing * dt) fastest = std::max(fastest, closing);
    }
  }
  return fastest;
}

std::optional<double> reaching_speed(const btRigidBody& body, std::span<const Vec3> local,
                                     const btCollisionObject& other, double near, double dt,
                                     ShapeCache& cache) {
  constexpr int kFewestLooks = 4, kMostLooks = 32;
  constexpr double kFall = 0.003;  // m: g dt^2 / 2 at 1/60 s is 1.4 mm
  double reach = 0.0;
  for (const Vec3& r : local) reach = std::max(reach, r.norm());
  const double way = largest_closing_speed(body, reach, other, dt) * dt;
  const int looks = static_cast<int>(
      std::clamp(std::ceil(way / (near + kFall)), double{kFewestLooks}, double{kMostLooks}));
  // Half a look ahead or back a point is this much nearer.
  const double margin = near + kFall + 0.5 * way / looks;
  const std::vector<Vec3> some = points_within(way + margin, other, body, local);
  if (some.empty()) return {};
  const std::vector<PointMotion> seen = seen_from(other, body, some, looks, dt);
  const Box3 box = box_around(seen);
  const Vec3 around = Vec3::Constant(margin);
  std::optional<double> fastest;
  for (const ContactPart& part :
       contact_parts(*other.getCollisionShape(), box.min() - around, box.max() + around, cache)) {
    if (part.for_faces) continue;  // points meet the triangles
    for (const PointMotion& point : seen) {
      const Penetration into = penetration(part, point.position);
      if (into.depth <= -margin) continue;
      fastest = std::max(fastest.value_or(0.0), -point.velocity.dot(into.normal));
    }
  }
  return fastest;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
