#include "bullet_bridge/support_contacts.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "bullet_bridge/body_motion.h"
#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Sweeps a substep. Impulses are carried over hundreds of substeps a tick, so that few are needed.
constexpr int kSweeps = 3;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

bool carries_load(const btPersistentManifold& manifold) {
  return manifold.getNumContacts() > 0 && manifold.getBody0()->hasContactResponse() &&
         manifold.getBody1()->hasContactResponse();
}

SupportContact make_contact(const btManifoldPoint& point, int a, int b, const ShadowSet& shadows) {
  SupportContact c;
  c.a = a;
  c.b = b;
  c.anchor_a = shadows[a].rotation.transpose() *
               (from_bullet(point.getPositionWorldOnA()) - shadows[a].position);
  c.anchor_b = shadows[b].rotation.transpose() *
               (from_bullet(point.getPositionWorldOnB()) - shadows[b].position);
  c.normal = from_bullet(point.m_normalWorldOnB).normalized();
  c.tangent[0] = c.normal.unitOrthogonal();
  c.tangent[1] = c.normal.cross(c.tangent[0]);
  c.friction = point.m_combinedFriction;
  return c;
}

// One direction of a contact with what does not change during the sweeps of a substep.
struct Axis {
  Vec3 direction;
  Vec3 shift_a, shift_b;        // velocity for a unit impulse, 1/kg
  Vec3 arm_a, arm_b;            // r x direction
  Vec3 turn_a, turn_b;          // I^-1 (r x direction)
  double effective_mass = 0.0;  // kg

  double relative_speed(const ShadowBody& a, const ShadowBody& b) const {
    return direction.dot(a.velocity - b.velocity) + arm_a.dot(a.angular_velocity) -
           arm_b.dot(b.angular_velocity);
  }
  void push(ShadowBody& a, ShadowBody& b, double impulse) const {
    a.velocity += impulse * shift_a;
    a.angular_velocity += impulse * turn_a;
    b.velocity -= impulse * shift_b;
    b.angular_velocity -= impulse * turn_b;
  }
};

Axis make_axis(const ShadowBody& a, const ShadowBody& b, const Vec3& on_a, const Vec3& on_b,
               const Vec3& direction) {
  Axis axis;
  axis.direction = direction;
  axis.shift_a = a.inverse_mass * a.linear_factor.cwiseProduct(direction);
  axis.shift_b = b.inverse_mass * b.linear_factor.cwiseProduct(direction);
  axis.arm_a = (on_a - a.position).cross(direction);
  axis.arm_b = (on_b - b.position).cross(direction);
  axis.turn_a = a.inverse_inertia * axis.arm_a;
  axis.turn_b = b.inverse_inertia * axis.arm_b;
  const double inverse_mass = direction.dot(axis.shift_a + axis.shift_b) +
                              axis.arm_a.dot(axis.turn_a) + axis.arm_b.dot(axis.turn_b);
  axis.effective_mass = inverse_mass > 0.0 ? 1.0 / inverse_mass : 0.0;
  return axis;
}

// A contact ready for the sweeps of one substep.
struct PreparedContact {
  SupportContact* contact;
  double gap = 0.0;  // m, not negative
  Axis axis[3];      // normal and two tangents
};

PreparedContact prepare(SupportContact& c, ShadowSet& shadows) {
  const ShadowBody& a = shadows[c.a];
  const ShadowBody& b = shadows[c.b];
  const Vec3 on_a = a.position + a.rotation * c.anchor_a;
  const Vec3 on_b = b.position + b.rotation * c.anchor_b;
  return {&c,
          std::max(0.0, c.normal.dot(on_a - on_b)),
          {make_axis(a, b, on_a, on_b, c.normal), make_axis(a, b, on_a, on_b, c.tangent[0]),
           make_axis(a, b, on_a, on_b, c.tangent[1])}};
}

void start_from_last_impulse(const PreparedContact& prepared, ShadowSet& shadows) {
  const SupportContact& c = *prepared.contact;
  ShadowBody& a = shadows[c.a];
  ShadowBody& b = shadows[c.b];
  prepared.axis[0].push(a, b, c.impulse);
  prepared.axis[1].push(a, b, c.tangent_impulse[0]);
  prepared.axis[2].push(a, b, c.tangent_impulse[1]);
}

// Changes one accumulated impulse so that the relative speed along the axis becomes `wanted`, but
// not below `low`.
void solve_axis(const Axis& axis, ShadowBody& a, ShadowBody& b, double wanted, double low,
                double& accumulated) {
  const double change = (wanted - axis.relative_speed(a, b)) * axis.effective_mass;
  const double total = std::max(accumulated + change, low);
  axis.push(a, b, total - accumulated);
  accumulated = total;
}

// Coulomb's cone: with the two tangents limited one by one, friction would point along a diagonal
// between them and push what slides off its line.
void limit_friction(const PreparedContact& prepared, ShadowBody& a, ShadowBody& b) {
  SupportContact& c = *prepared.contact;
  const double most = c.friction * c.impulse;
  const double size = std::hypot(c.tangent_impulse[0], c.tangent_impulse[1]);
  if (size <= most) return;
  for (int t = 0; t < 2; ++t) {
    const double limited = c.tangent_impulse[t] * (most / size);
    prepared.axis[t + 1].push(a, b, limited - c.tangent_impulse[t]);
    c.tangent_impulse[t] = limited;
  }
}

void solve_contact(const PreparedContact& prepared, ShadowSet& shadows, double dt) {
  SupportContact& c = *prepared.contact;
  ShadowBody& a = shadows[c.a];
  ShadowBody& b = shadows[c.b];
  // An open contact may close within dt; faster separation is left alone because low = 0.
  solve_axis(prepared.axis[0], a, b, -prepared.gap / dt, 0.0, c.impulse);
  for (int t = 0; t < 2; ++t) {
    solve_axis(prepared.axis[t + 1], a, b, 0.0, -kUnlimited, c.tangent_impulse[t]);
  }
  limit_friction(prepared, a, b);
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

void ShadowSet::next_tick() {
  last_tick_ = std::exchange(shadows_, {});
  last_index_ = std::exchange(index_, {});
  objects_.clear();
}

int ShadowSet::shadow_of(const btCollisionObject& object) {
  const auto [found, inserted] = index_.try_emplace(&object, size());
  if (inserted) {
    shadows_.push_back(make_shadow(object));
    const auto then = last_index_.find(&object);
    if (then != last_index_.end()) go_on_from(shadows_.back(), last_tick_[then->second]);
    objects_.push_back(&object);
  }
  return found->second;
}

int ShadowSet::find(const btCollisionObject& object) const {
  const auto found = index_.find(&object);
  return found == index_.end() ? -1 : found->second;
}

std::vector<SupportContact> gather_support_contacts(btDispatcher& dispatcher, ShadowSet& shadows) {
  std::vector<SupportContact> contacts;
  std::vector<bool> done(static_cast<std::size_t>(dispatcher.getNumManifolds()), false);
  for (int ring = 0; ring < kSupportRings; ++ring) {
    const int known = shadows.size();
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
      if (done[m] || !carries_load(manifold)) continue;
      const btCollisionObject& first = *manifold.getBody0();
      const btCollisionObject& second = *manifold.getBody1();
      // Only through bodies of the rings before this one, and never through the ground.
      const int i = is_movable(first) ? shadows.find(first) : -1;
      const int j = is_movable(second) ? shadows.find(second) : -1;
      if ((i < 0 || i >= known) && (j < 0 || j >= known)) continue;
      done[m] = true;
      const int a = shadows.shadow_of(first), b = shadows.shadow_of(second);
      for (int p = 0; p < manifold.getNumContacts(); ++p) {
        contacts.push_back(make_contact(manifold.getContactPoint(p), a, b, shadows));
      }
    }
  }
  return contacts;
}

std::vector<bool> touches_beyond(btDispatcher& dispatcher, const ShadowSet& shadows) {
  std::vector<bool> beyond(static_cast<std::size_t>(shadows.size()), false);
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    if (!carries_load(manifold)) continue;
    const int a = shadows.find(*manifold.getBody0()), b = shadows.find(*manifold.getBody1());
    if (a >= 0 && b < 0) beyond[a] = true;
    if (b >= 0 && a < 0) beyond[b] = true;
  }
  return beyond;
}

std::vector<SupportGroup> group_support_contacts(const std::vector<SupportContact>& contacts,
                                                 const ShadowSet& shadows,
                                                 const std::vector<bool>& beyond) {
  std::vector<int> parent(static_cast<std::size_t>(shadows.size()));
  std::iota(parent.begin(), parent.end(), 0);
  for (const SupportContact& c : contacts) {
    if (!shadows[c.a].movable() || !shadows[c.b].movable()) continue;
    const int a = root_of(parent, c.a), b = root_of(parent, c.b);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<int> group_of(parent.size(), -1);
  std::vector<SupportGroup> groups;
  for (int i = 0; i < shadows.size(); ++i) {
    if (!shadows[i].movable()) continue;
    const int root = root_of(parent, i);
    if (group_of[root] < 0) {
      group_of[root] = static_cast<int>(groups.size());
      groups.emplace_back();
    }
    group_of[i] = group_of[root];
    groups[group_of[i]].bodies.push_back(i);
    groups[group_of[i]].stands = groups[group_of[i]].stands || beyond[i];
  }
  for (const SupportContact& c : contacts) {
    const int body = shadows[c.a].movable() ? c.a : c.b;
    SupportGroup& group = groups[group_of[body]];
    group.contacts.push_back(c);
    group.stands = group.stands || !shadows[c.a].movable() || !shadows[c.b].movable();
  }
  return groups;
}

void solve_support_contacts(std::vector<SupportContact>& contacts, ShadowSet& shadows, double dt) {
  std::vector<PreparedContact> prepared;
  prepared.reserve(contacts.size());
  for (SupportContact& c : contacts) prepared.push_back(prepare(c, shadows));
  for (const PreparedContact& c : prepared) start_from_last_impulse(c, shadows);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const PreparedContact& c : prepared) solve_contact(c, shadows, dt);
  }
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
