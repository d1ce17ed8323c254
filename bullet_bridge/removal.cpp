#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <string>

#include "bullet_bridge/co_simulation_impl.h"
#include "bullet_bridge/conversions.h"
#include "bullet_bridge/neighbourhood.h"

// An object leaves. Its share of the lattice stays, without a role, so that no index moves: those
// of objects, pieces and records are a game's, those of points are in the books of contacts.

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

bool contains(IdRange<PointId> range, std::int32_t point) {
  return point >= range.begin && point < range.end;
}

// Between two steps: Bullet gives what is awake then its gravity with the next one. A whole island,
// for what wakes within a step has missed that (waking.h). What is awake may be about to fall
// asleep.
void wake_island_of(btCollisionWorld& world, const btCollisionObject& body) {
  if (body.isStaticOrKinematicObject()) return;
  const int island = body.isActive() ? -1 : body.getIslandTag();
  for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
    btCollisionObject& other = *world.getCollisionObjectArray()[i];
    if (&other == &body || (island >= 0 && other.getIslandTag() == island)) other.activate();
  }
}

// What rests on it would sleep on in the air. Contacts of lattices are in no manifold: boxes tell.
void wake_what_touches(btCollisionWorld& world, btRigidBody& body) {
  if (!body.isInWorld()) return;
  btVector3 low, high;
  body.getCollisionShape()->getAabb(body.getWorldTransform(), low, high);
  const Vec3 around = Vec3::Constant(gContactBreakingThreshold);
  for (const btCollisionObject* other :
       bodies_in(world, from_bullet(low) - around, from_bullet(high) + around)) {
    wake_island_of(world, *other);
  }
}

}  // namespace

void CoSimulation::Impl::require_object(std::size_t object) const {
  if (has_object(object)) return;
  const std::string where = "object " + std::to_string(object);
  if (object >= removed_.size()) {
    throw InputError({where, "there is none: " + std::to_string(removed_.size()) + " were added",
                      "use an index that add() returned"});
  }
  throw InputError({where + " (" + lattice_.objects[object].authored.name + ")", "it was removed",
                    "ask has_object() before, or forget its index when you remove it"});
}

void CoSimulation::Impl::require_removable(std::size_t object) const {
  require_object(object);
  const std::string& name = lattice_.objects[object].authored.name;
  if (in_tick_) {
    throw InputError({name, "it cannot be removed in the middle of a step",
                      "remove it before or after stepSimulation()"});
  }
  const std::size_t constraints = constraints_on(object).size();
  if (constraints == 0) return;
  throw InputError({name,
                    std::to_string(constraints) + " of the world's constraints name its bodies",
                    "take those that constraints_on() lists out of the world first"});
}

std::vector<btTypedConstraint*> CoSimulation::Impl::constraints_on(std::size_t object) const {
  std::unordered_set<const btRigidBody*> bodies;
  for (const auto& piece : pieces_) {
    if (piece->object == object) bodies.insert(&piece->body());
  }
  for (const Orphan& orphan : orphans_) {
    if (orphan.object == object) bodies.insert(orphan.body.get());
  }
  std::vector<btTypedConstraint*> constraints;
  for (int i = 0; i < world_.getNumConstraints(); ++i) {
    btTypedConstraint* constraint = world_.getConstraint(i);
    if (bodies.contains(&constraint->getRigidBodyA()) ||
        bodies.contains(&constraint->getRigidBodyB())) {
      constraints.push_back(constraint);
    }
  }
  return constraints;
}

void CoSimulation::Impl::remove(std::size_t object) {
  require_removable(object);
  const IdRange<PointId> points = lattice_.objects[object].points;
  const auto is_of_it = [&](const auto& thing) { return thing->object == object; };
  for (const auto& piece : pieces_) {
    if (!is_of_it(piece)) continue;
    wake_what_touches(world_, piece->body());
    contacts_.forget(piece->body());
    contacts_.give_up(piece->id);
    counters_.stored_J -= piece->stored_J;
  }
  std::erase_if(pieces_, is_of_it);
  std::erase_if(orphans_, [&](const Orphan& orphan) { return orphan.object == object; });
  std::erase_if(pushes_, [&](const Push& push) { return contains(points, push.points.front()); });
  std::erase_if(loads_, [&](const PointLoad& load) { return contains(points, load.point); });
  debris_.forget(points);
  passing_.clear();  // a failure may have left some
  index_.pieces_changed();
  retire_object(lattice_, object);
  removed_[object] = true;
  roles_stale_ = true;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
