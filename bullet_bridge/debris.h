#pragma once

#include <unordered_set>
#include <vector>

#include "bullet_bridge/precision.h"
#include "core/dynamics/lattice.h"

class btDiscreteDynamicsWorld;
class btCollisionObject;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// Points that lost all their edges: ballistic particles at the tick rate, the same in every
// representation. They fall on the world's bodies (not on Limber's own proxies, whose hulls they
// are born in) by a ray along their path; a hit is inelastic with friction and gives a movable body
// the momentum that the particle loses.
class Debris {
 public:
  // `born_in`: the middle of the piece that it came off, m.
  void add(std::int32_t point, const Vec3& born_in) {
    points_.push_back({.point = point, .born_in = born_in});
  }
  std::size_t size() const { return points_.size(); }

  // Lets those of an object go.
  void forget(IdRange<PointId> points);

  // One tick for all: x += (v + v') dt / 2, v' = v + g dt, or to the first hit. Particles older
  // than `lifetime` (s) are let go; returns their mass, kg.
  double step(btDiscreteDynamicsWorld& world, Lattice& lattice,
              const std::unordered_set<const btCollisionObject*>& ignored, double dt,
              double lifetime);

 private:
  struct Particle {
    std::int32_t point = 0;
    Vec3 born_in = Vec3::Zero();
    bool resting = false;
    double age = 0.0;  // s
  };
  void lift_out(const Particle& particle, btDiscreteDynamicsWorld& world, Lattice& lattice,
                const std::unordered_set<const btCollisionObject*>& ignored) const;
  void move(Particle& particle, btDiscreteDynamicsWorld& world, Lattice& lattice,
            const std::unordered_set<const btCollisionObject*>& ignored, double dt) const;

  std::vector<Particle> points_;
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
