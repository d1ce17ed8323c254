#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bullet_bridge/obstacle.h"
#include "bullet_bridge/support_contacts.h"
#include "core/dynamics/components.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// A part of the contacts that has no lattice point and no movable body in common with any other:
// clusters may press at once, and each sums in the order in which all of them would one after the
// other.
struct ContactCluster {
  struct Part {
    std::size_t obstacle;  // its number
    ObstacleShare share;
  };
  std::vector<Part> parts;   // in the order of the obstacles
  bool asks_bullet = false;  // then it is for the calling thread
};

// Of the pairs that the obstacles have listed. Pieces that may touch the same movable body are of
// one cluster; what does not move parts them. The first cluster is all that asks Bullet, if
// anything does. Clusters too small for a thread of their own are put together.
std::vector<ContactCluster> contact_clusters(std::span<const Obstacle> obstacles,
                                             const ShadowSet& shadows, const Components& pieces);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
