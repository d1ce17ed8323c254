#include "bullet_bridge/neighbourhood.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bullet_bridge/body_motion.h"
#include "bullet_bridge/conversions.h"
#include "bullet_bridge/lattice_shape.h"
#include "bullet_bridge/shadow_body.h"
#include "bullet_bridge/shapes/contact_shape.h"
#include "core/model/bounds.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

constexpr double kReachMargin = 0.01;  // m, beyond the way at the present speed
constexpr std::size_t kMostSamples = 300;

bool is_met(const btCollisionObject& object) {
  const int type = object.getInternalType();
  const bool body = type == btCollisionObject::CO_RIGID_BODY ||
                    type == btCollisionObject::CO_COLLISION_OBJECT ||
                    type == btCollisionObject::CO_FEATHERSTONE_LINK;
  return body && object.hasContactResponse() && !stands_for_lattice(object);
}

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

// Where the points are on their way through the tick, in the frame of the other body, m.
std::vector<Vec3> places_seen_from(const btCollisionObject& other, const btCollisionObject& body,
                                   std::span<const Vec3> local, double dt) {
  constexpr int kLooks = 4;
  ShadowBody mine = make_shadow(body), partner = make_shadow(other);
  std::vector<Vec3> places;
  for (int look = 0; look < kLooks; ++look) {
    advance_pose(mine, dt / kLooks);
    advance_pose(partner, dt / kLooks);
    for (const Vec3& r : local) {
      const Vec3 at = mine.position + mine.rotation * r;
      places.push_back(partner.rotation.transpose() * (at - partner.position));
    }
  }
  return places;
}

}  // namespace

std::vector<NearBody> sweeping_bodies(const btCollisionWorld& world, double dt) {
  std::vector<NearBody> sweeping;
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) {
    const btCollisionObject& object = *objects[i];
    if (object.isStaticObject() || is_movable(object) || !is_met(object)) continue;
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

bool points_reach(const btCollisionObject& body, std::span<const Vec3> local,
                  const btCollisionObject& other, double dt, ShapeCache& cache) {
  constexpr double kMargin = 0.003;  // m: g dt^2 / 2 at 1/60 s is 1.4 mm
  const std::vector<Vec3> places = places_seen_from(other, body, local, dt);
  const Box3 box = limber::bounds_of(places);
  const Vec3 margin = Vec3::Constant(kMargin);
  const std::vector<ContactPart> parts =
      contact_parts(*other.getCollisionShape(), box.min() - margin, box.max() + margin, cache);
  return std::any_of(parts.begin(), parts.end(), [&](const ContactPart& part) {
    return std::any_of(places.begin(), places.end(), [&](const Vec3& place) {
      return penetration(part, place).depth > -kMargin;
    });
  });
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
