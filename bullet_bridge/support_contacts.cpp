#include "bullet_bridge/support_contacts.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Sweeps a substep. Impulses are carried over hundreds of substeps a tick, so that few are needed.
constexpr int kSweeps = 3;

bool carries_load(const btPersistentManifold& manifold) {
  return manifold.getNumContacts() > 0 && manifold.getBody0()->hasContactResponse() &&
         manifold.getBody1()->hasContactResponse();
}

bool movable(const btCollisionObject& object) { return !object.isStaticOrKinematicObject(); }

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

struct ContactGeometry {
  Vec3 on_a, on_b;
  double relative_speed(const ShadowBody& a, const ShadowBody& b, const Vec3& axis) const {
    return axis.dot(a.velocity_at(on_a) - b.velocity_at(on_b));
  }
  double inverse_mass(const ShadowBody& a, const ShadowBody& b, const Vec3& axis) const {
    return a.inverse_effective_mass(on_a, axis) + b.inverse_effective_mass(on_b, axis);
  }
  void push(ShadowBody& a, ShadowBody& b, const Vec3& impulse) const {
    a.apply_impulse(impulse, on_a);
    b.apply_impulse(-impulse, on_b);
  }
};

ContactGeometry geometry(const SupportContact& c, const ShadowSet& shadows) {
  return {shadows[c.a].position + shadows[c.a].rotation * c.anchor_a,
          shadows[c.b].position + shadows[c.b].rotation * c.anchor_b};
}

void start_from_last_impulse(const SupportContact& c, ShadowSet& shadows) {
  geometry(c, shadows).push(shadows[c.a], shadows[c.b],
                            c.impulse * c.normal + c.tangent_impulse[0] * c.tangent[0] +
                                c.tangent_impulse[1] * c.tangent[1]);
}

// Changes one accumulated impulse so that the relative speed along `axis` becomes `wanted`, within
// [low, high].
void solve_axis(const ContactGeometry& at, ShadowBody& a, ShadowBody& b, const Vec3& axis,
                double wanted, double low, double high, double& accumulated) {
  const double inverse_mass = at.inverse_mass(a, b, axis);
  if (inverse_mass <= 0.0) return;
  const double change = (wanted - at.relative_speed(a, b, axis)) / inverse_mass;
  const double total = std::clamp(accumulated + change, low, high);
  at.push(a, b, (total - accumulated) * axis);
  accumulated = total;
}

void solve_contact(SupportContact& c, ShadowSet& shadows, double dt) {
  ShadowBody& a = shadows[c.a];
  ShadowBody& b = shadows[c.b];
  const ContactGeometry at = geometry(c, shadows);
  const double gap = std::max(0.0, c.normal.dot(at.on_a - at.on_b));
  solve_axis(at, a, b, c.normal, -gap / dt, 0.0, 1e300, c.impulse);
  // A contact that only may close later leaves faster separation alone: low = 0 sees to that.
  const double most = c.friction * c.impulse;
  for (int t = 0; t < 2; ++t) {
    solve_axis(at, a, b, c.tangent[t], 0.0, -most, most, c.tangent_impulse[t]);
  }
}

}  // namespace

void ShadowSet::clear() {
  shadows_.clear();
  objects_.clear();
  index_.clear();
}

int ShadowSet::shadow_of(const btCollisionObject& object) {
  const auto [found, inserted] = index_.try_emplace(&object, size());
  if (inserted) {
    shadows_.push_back(make_shadow(object));
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
      const int i = movable(first) ? shadows.find(first) : -1;
      const int j = movable(second) ? shadows.find(second) : -1;
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

void solve_support_contacts(std::vector<SupportContact>& contacts, ShadowSet& shadows, double dt) {
  for (const SupportContact& c : contacts) start_from_last_impulse(c, shadows);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (SupportContact& c : contacts) solve_contact(c, shadows, dt);
  }
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
