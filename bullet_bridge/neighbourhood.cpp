#include "bullet_bridge/neighbourhood.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

#include <algorithm>
#include <cmath>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

constexpr double kReachMargin = 0.01;    // m, beyond the way at the present speed
constexpr std::size_t kMostSamples = 300;

struct Collector : btBroadphaseAabbCallback {
  std::vector<const btCollisionObject*> found;
  bool process(const btBroadphaseProxy* proxy) override {
    const auto* object = static_cast<const btCollisionObject*>(proxy->m_clientObject);
    const int type = object->getInternalType();
    const bool body = type == btCollisionObject::CO_RIGID_BODY ||
                      type == btCollisionObject::CO_COLLISION_OBJECT;
    if (body && object->hasContactResponse()) found.push_back(object);
    return true;
  }
};

std::vector<std::int32_t> sample(std::span<const std::int32_t> points) {
  const std::size_t stride = 1 + points.size() / kMostSamples;
  std::vector<std::int32_t> some;
  for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
  return some;
}

}  // namespace

std::vector<const btCollisionObject*> bodies_within_reach(btDiscreteDynamicsWorld& world,
                                                          const Lattice& lattice,
                                                          std::span<const std::int32_t> points,
                                                          double dt) {
  Vec3 low = Vec3::Constant(1e30), high = Vec3::Constant(-1e30);
  double fastest = 0.0;
  for (std::int32_t p : points) {
    low = low.cwiseMin(lattice.motion[p].position);
    high = high.cwiseMax(lattice.motion[p].position);
    fastest = std::max(fastest, lattice.motion[p].velocity.squaredNorm());
  }
  const Vec3 reach = Vec3::Constant(1.5 * std::sqrt(fastest) * dt + kReachMargin);
  Collector collector;
  world.getBroadphase()->aabbTest(to_bullet(low - reach), to_bullet(high + reach), collector);
  std::sort(collector.found.begin(), collector.found.end(),
            [](const btCollisionObject* a, const btCollisionObject* b) {
              return a->getWorldArrayIndex() < b->getWorldArrayIndex();
            });
  return collector.found;
}

double closing_speed(const Lattice& lattice, std::span<const std::int32_t> one,
                     std::span<const std::int32_t> other, double dt) {
  const std::vector<std::int32_t> mine = sample(one), others = sample(other);
  // A sample with stride s has gaps of sqrt(s) spacings between its points.
  const double stride = 1.0 + static_cast<double>(std::max(one.size(), other.size()) / kMostSamples);
  double fastest = 0.0;
  for (std::int32_t p : mine) {
    for (std::int32_t q : others) {
      const Vec3 d = lattice.motion[q].position - lattice.motion[p].position;
      const Vec3 w = lattice.motion[q].velocity - lattice.motion[p].velocity;
      const double distance = d.norm();
      const double touch =
          2.0 * std::sqrt(stride) * (lattice.contact_radius[p] + lattice.contact_radius[q]);
      const double closing = distance > 0.0 ? -w.dot(d) / distance : w.norm();
      if (distance - touch <= closing * dt) fastest = std::max(fastest, closing);
    }
  }
  return fastest;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
