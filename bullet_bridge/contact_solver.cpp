#include "bullet_bridge/contact_solver.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <utility>

#include "bullet_bridge/conversions.h"
#include "bullet_bridge/waking.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Substeps for which the points near a body are listed. A point is listed when it can get there at
// twice its own speed; a quarter of the fastest point's way and a millimetre allow for pushes.
constexpr int kListInterval = 32;
constexpr double kPushShare = 0.25;
constexpr double kListMargin = 1e-3;  // m

// A penetration that was there when a contact was first seen is taken back at this speed, m/s: it
// bounds the kinetic energy per mass that easing out may cost to 1.25 mJ/kg, and clears a shell's
// wall of 5 mm in 0.1 s. Without it pieces that thaw again and again sink into the floor.
constexpr double kEaseSpeed = 0.05;

Vec3 gravity_of(const ShadowBody& shadow) {
  return shadow.movable() ? from_bullet(shadow.body->getGravity()) : Vec3(Vec3::Zero());
}

PenaltyContact law_between(const LatticeObject& object, const btCollisionObject& body) {
  const ObjectAttributes& attributes = object.authored.object;
  PenaltyContact law;
  law.frequency = object.contact_frequency;
  law.restitution = attributes.restitution * body.getRestitution();
  law.friction = attributes.friction * body.getFriction();
  return law;
}

bool before(std::int32_t point_a, std::int32_t part_a, std::int32_t point_b, std::int32_t part_b) {
  return std::pair(point_a, part_a) < std::pair(point_b, part_b);
}

}  // namespace

void ContactSolver::begin_tick(btDiscreteDynamicsWorld& world, const Lattice& lattice,
                               std::span<const btCollisionObject* const> near,
                               std::span<const CarriedPiece> carried) {
  shadows_.clear();
  last_tick_ = std::exchange(obstacles_, {});
  carried_.assign(carried.begin(), carried.end());
  carried_shadow_.clear();
  substep_ = 0;
  for (const btCollisionObject* object : near) {
    obstacles_.push_back(make_obstacle(*object, lattice));
  }
  for (const CarriedPiece& piece : carried_) {
    carried_shadow_.push_back(shadows_.shadow_of(*piece.body));
  }
  const std::vector<SupportContact> contacts =
      gather_support_contacts(*world.getDispatcher(), shadows_);
  supports_ = group_support_contacts(contacts, shadows_);
  supported_.assign(static_cast<std::size_t>(shadows_.size()), false);
  for (const SupportContact& c : contacts) supported_[c.a] = supported_[c.b] = true;
  give_back_offsets();
}

ContactSolver::Obstacle ContactSolver::make_obstacle(const btCollisionObject& object,
                                                     const Lattice& lattice) {
  Obstacle obstacle;
  obstacle.shadow = shadows_.shadow_of(object);
  obstacle.object = &object;
  obstacle.parts = contact_parts(*object.getCollisionShape());
  for (const LatticeObject& other : lattice.objects) {
    obstacle.laws.push_back(law_between(other, object));
  }
  const ShadowBody& body = shadows_[obstacle.shadow];
  obstacle.at_rest = !body.movable() && !body.moves();
  if (obstacle.at_rest) {
    for (ContactPart& part : obstacle.parts) part = placed(part, body.position, body.rotation);
  }
  return obstacle;
}

Vec3 ContactSolver::to_obstacle_frame(const Obstacle& obstacle, const Vec3& point) const {
  if (obstacle.at_rest) return point;
  const ShadowBody& body = shadows_[obstacle.shadow];
  return body.rotation.transpose() * (point - body.position);
}

// Contacts of the last tick are found again with their offsets.
void ContactSolver::give_back_offsets() {
  for (Obstacle& now : obstacles_) {
    for (Obstacle& then : last_tick_) {
      if (then.object == now.object) now.candidates = std::move(then.candidates);
    }
  }
  last_tick_.clear();
}

void ContactSolver::add_forces(Lattice& lattice, double dt) {
  if (substep_++ % kListInterval == 0) list_candidates(lattice, dt);
  for (Obstacle& obstacle : obstacles_) {
    for (Candidate& candidate : obstacle.candidates) push(lattice, obstacle, candidate, dt);
  }
}

void ContactSolver::list_candidates(const Lattice& lattice, double dt) {
  double fastest = 0.0;
  for (std::int32_t p : lattice.dynamic_points) {
    fastest = std::max(fastest, lattice.motion[p].velocity.squaredNorm());
  }
  fastest = std::sqrt(fastest);
  for (Obstacle& obstacle : obstacles_) {
    const ShadowBody& body = shadows_[obstacle.shadow];
    double body_speed = body.velocity.norm();
    if (body.movable()) {
      btVector3 centre;
      btScalar radius = 0;
      obstacle.object->getCollisionShape()->getBoundingSphere(centre, radius);
      body_speed += body.angular_velocity.norm() * radius;
    }
    const double time = kListInterval * dt;
    const double least_reach = (2.0 * body_speed + kPushShare * fastest) * time + kListMargin;
    list_candidates_of(obstacle, lattice, least_reach, 2.0 * time);
  }
}

void ContactSolver::list_candidates_of(Obstacle& obstacle, const Lattice& lattice,
                                       double least_reach, double time) {
  const std::vector<Candidate> old = std::exchange(obstacle.candidates, {});
  for (std::int32_t p : lattice.dynamic_points) {
    const Vec3 local = to_obstacle_frame(obstacle, lattice.motion[p].position);
    const double reach = least_reach + lattice.motion[p].velocity.norm() * time;
    for (std::size_t k = 0; k < obstacle.parts.size(); ++k) {
      const double depth = penetration(obstacle.parts[k], local).depth;
      if (depth < -reach) continue;
      const auto part = static_cast<std::int32_t>(k);
      const auto known = std::lower_bound(old.begin(), old.end(), std::pair(p, part),
                                          [](const Candidate& c, const auto& key) {
                                            return before(c.point, c.part, key.first, key.second);
                                          });
      const bool listed_before = known != old.end() && known->point == p && known->part == part;
      // A point that is found inside without having come in starts without force (a proxy that
      // thaws where its hull touches): the depth it has counts as surface until it has left.
      const double offset = listed_before ? known->offset : std::max(0.0, depth);
      obstacle.candidates.push_back({p, part, offset});
    }
  }
}

void ContactSolver::push(Lattice& lattice, const Obstacle& obstacle, Candidate& candidate,
                         double dt) {
  ShadowBody& body = shadows_[obstacle.shadow];
  const PointMotion& point = lattice.motion[candidate.point];
  const Vec3 local = to_obstacle_frame(obstacle, point.position);
  const ContactPart& part = obstacle.parts[candidate.part];
  if (!contains(part, local)) {
    candidate.offset = 0.0;
    return;
  }
  const Penetration inside = penetration(part, local);
  candidate.offset =
      std::min(std::max(0.0, candidate.offset - kEaseSpeed * dt), std::max(0.0, inside.depth));
  const double depth = inside.depth - candidate.offset;
  if (depth <= 0.0) return;

  const Vec3 normal = obstacle.at_rest ? inside.normal : Vec3(body.rotation * inside.normal);
  const double mass = lattice.mass[candidate.point];
  const double reduced_mass =
      body.movable() ? 1.0 / (1.0 / mass + body.inverse_effective_mass(point.position, normal))
                     : mass;
  const PenaltyContact& law = obstacle.laws[lattice.point_object[candidate.point]];
  const Vec3 slip = point.velocity - body.velocity_at(point.position);
  const double separation = slip.dot(normal);
  const double press = penalty_force(law, reduced_mass, depth, separation);
  const Vec3 force = press * normal + friction_force(law.friction, press, reduced_mass,
                                                     slip - separation * normal, dt);
  lattice.force[candidate.point] += force;
  lattice.touched[candidate.point] = 1;
  if (body.movable()) body.add_force(-force, point.position);
}

void ContactSolver::advance(Lattice& lattice, double dt) {
  pass_on_carried_forces(lattice);
  for (int i = 0; i < shadows_.size(); ++i) {
    ShadowBody& body = shadows_[i];
    if (!body.movable()) continue;
    if (body.touched) apply_forces(body, dt);
    if (!supported_[i]) body.velocity += gravity_of(body) * dt;
  }
  for (SupportGroup& group : supports_) {
    group.loaded = group.loaded || std::any_of(group.bodies.begin(), group.bodies.end(),
                                               [&](int i) { return shadows_[i].touched; });
    if (group.loaded) solve_support_contacts(group.contacts, shadows_, dt);
  }
  for (int i = 0; i < shadows_.size(); ++i) {
    if (shadows_[i].moves()) advance_pose(shadows_[i], dt);
  }
  move_carried_points(lattice);
}

void ContactSolver::pass_on_carried_forces(const Lattice& lattice) {
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    ShadowBody& body = shadows_[carried_shadow_[i]];
    for (std::int32_t p : carried_[i].points) {
      if (lattice.force[p].isZero(0.0)) continue;
      body.add_force(lattice.force[p], lattice.motion[p].position);
    }
  }
}

void ContactSolver::move_carried_points(Lattice& lattice) const {
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    const ShadowBody& body = shadows_[carried_shadow_[i]];
    if (!body.moves()) continue;
    for (std::size_t k = 0; k < carried_[i].points.size(); ++k) {
      const Vec3 arm = body.rotation * carried_[i].local[k];
      lattice.motion[carried_[i].points[k]] = {body.position + arm,
                                               body.velocity + body.angular_velocity.cross(arm)};
    }
  }
}

void ContactSolver::write_velocities(btDiscreteDynamicsWorld& world, double tick) {
  for (const SupportGroup& group : supports_) {
    for (int i : group.bodies) shadows_[i].touched = shadows_[i].touched || group.loaded;
  }
  for (int i = 0; i < shadows_.size(); ++i) {
    ShadowBody& body = shadows_[i];
    if (!body.movable() || !body.touched) continue;
    // A sleeper that nothing reached sleeps on.
    if (!body.body->isActive() && !body.moves()) continue;
    wake(world, *body.body);
    // Bullet is about to add this tick's gravity, which an airborne shadow has had already.
    const Vec3 fall = supported_[i] ? Vec3(Vec3::Zero()) : Vec3(gravity_of(body) * tick);
    write_velocity(body, body.velocity - fall);
  }
}

void ContactSolver::correct_poses(double tick) {
  for (int i = 0; i < shadows_.size(); ++i) {
    if (shadows_[i].movable() && shadows_[i].touched) correct_pose(shadows_[i], tick);
  }
}

bool ContactSolver::touched(const btCollisionObject& object) const {
  const int i = shadows_.find(object);
  return i >= 0 && shadows_[i].touched;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
