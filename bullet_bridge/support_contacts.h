#pragma once

#include <unordered_map>
#include <vector>

#include "bullet_bridge/shadow_body.h"

class btDispatcher;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// The shadows of one tick, found by the body they stand for.
class ShadowSet {
 public:
  // Those of the last tick are known still; not those before.
  void next_tick();
  // The shadow of an object, made on first use.
  int shadow_of(const btCollisionObject& object);
  // Another object may get its address.
  void forget(const btCollisionObject& object) { index_.erase(&object); }
  // -1 when it has none.
  int find(const btCollisionObject& object) const;
  ShadowBody& operator[](int i) { return shadows_[static_cast<std::size_t>(i)]; }
  const ShadowBody& operator[](int i) const { return shadows_[static_cast<std::size_t>(i)]; }
  const btCollisionObject& object(int i) const { return *objects_[static_cast<std::size_t>(i)]; }
  int size() const { return static_cast<int>(shadows_.size()); }

 private:
  using Index = std::unordered_map<const btCollisionObject*, int>;  // for look-ups, never iterated

  std::vector<ShadowBody> shadows_, last_tick_;
  std::vector<const btCollisionObject*> objects_;
  Index index_, last_index_;
};

// A point where two bodies of Bullet touch, kept for one tick: what carries a body that a lattice
// presses on. Without these a box on the ground gives way for a whole tick (energy +105 %,
// measured).
struct SupportContact {
  int a = -1, b = -1;       // shadows
  Vec3 anchor_a, anchor_b;  // in the bodies' frames, m
  Vec3 normal;              // world, from b to a
  Vec3 tangent[2];          // world
  double friction = 0.0;
  double impulse = 0.0;  // of the last substep, N s, >= 0: where the next one starts
  double tangent_impulse[2] = {0.0, 0.0};
};

// Rings of bodies around those a lattice may press on that are moved with it. The last ring has no
// supports of its own in the shadow; Bullet gives it those after the substeps.
inline constexpr int kSupportRings = 3;

// Collects the contact points that Bullet found for the movable shadows, ring by ring, adding a
// shadow for each body on the way. Call it when the first ring is in the set.
std::vector<SupportContact> gather_support_contacts(btDispatcher& dispatcher, ShadowSet& shadows);

// Which shadows touch, in Bullet's manifolds, what has no shadow: the last ring does.
std::vector<bool> touches_beyond(btDispatcher& dispatcher, const ShadowSet& shadows);

// Contacts that hang together through movable bodies: solved as one, and only when the lattice
// pushed one of their bodies.
struct SupportGroup {
  std::vector<SupportContact> contacts;
  std::vector<int> bodies;  // movable shadows
  bool loaded = false;
  bool stands = false;  // on something immovable, or on bodies without a shadow
};

std::vector<SupportGroup> group_support_contacts(const std::vector<SupportContact>& contacts,
                                                 const ShadowSet& shadows,
                                                 const std::vector<bool>& beyond);

// One substep of non-penetration with Coulomb friction: sequential impulses, started from those of
// the last substep. A gap may close within dt but not beyond.
void solve_support_contacts(std::vector<SupportContact>& contacts, ShadowSet& shadows, double dt);

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
