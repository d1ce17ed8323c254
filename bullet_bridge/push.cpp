#include "bullet_bridge/push.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "bullet_bridge/proxy_frame.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

RigidChange rigid_change(const Lattice& lattice, std::span<const std::int32_t> points,
                         const Impulse& impulse) {
  const RigidMotion now = rigid_motion(lattice.motion, lattice.mass, points);
  return {now.centre, impulse.linear / now.mass,
          angular_velocity_of(now.inertia, impulse.angular, kSmallestMomentShare)};
}

void push_rigidly(Lattice& lattice, std::span<const std::int32_t> points, const Impulse& impulse) {
  const RigidChange change = rigid_change(lattice, points, impulse);
  for (std::int32_t p : points) {
    if (lattice.inverse_mass[p] == 0.0) continue;
    lattice.motion[p].velocity += change.at(lattice.motion[p].position);
  }
}

void move_rigidly(Lattice& lattice, std::span<const std::int32_t> points, const Impulse& impulse,
                  double tick, const Vec3& shift) {
  const RigidChange change = rigid_change(lattice, points, impulse);
  const Vec3 turn = change.angular_velocity * tick;
  const Mat3 turned = Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix();
  for (std::int32_t p : points) {
    PointMotion& point = lattice.motion[p];
    point.velocity += change.at(point.position);
    point.position =
        change.centre + shift + change.velocity * tick + turned * (point.position - change.centre);
  }
}

std::vector<std::int32_t> points_around(const Lattice& lattice,
                                        std::span<const std::int32_t> points, const Vec3& place) {
  constexpr std::size_t kCorners = 8;
  const auto nearer = [&](std::int32_t p, std::int32_t q) {
    return (lattice.motion[p].position - place).squaredNorm() <
           (lattice.motion[q].position - place).squaredNorm();
  };
  std::vector<std::int32_t> nearest(std::min(kCorners, points.size()));
  std::partial_sort_copy(points.begin(), points.end(), nearest.begin(), nearest.end(), nearer);
  std::sort(nearest.begin(), nearest.end());
  return nearest;
}

std::vector<PointLoad> spread(const Lattice& lattice, std::span<const std::int32_t> points,
                              const Impulse& impulse, double tick) {
  const RigidChange change = rigid_change(lattice, points, impulse);
  std::vector<PointLoad> loads;
  for (std::int32_t p : points) {
    loads.push_back({p, lattice.mass[p] / tick * change.at(lattice.motion[p].position)});
  }
  return loads;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
