#include "bullet_bridge/contact_solver.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <utility>

#include "bullet_bridge/body_motion.h"
#include "bullet_bridge/conversions.h"
#include "bullet_bridge/waking.h"
#include "core/threads/parallel_for.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Substeps for which the points near a body are listed. A point is listed when it can get there at
// twice its own speed; a quarter of the fastest point's way and a millimetre allow for pushes.
constexpr int kListInterval = 32;
constexpr double kPushShare = 0.25;
constexpr double kListMargin = 1e-3;  // m

Vec3 gravity_of(const ShadowBody& shadow) {
  if (!shadow.movable()) return Vec3::Zero();
  return shadow.linear_factor.cwiseProduct(from_bullet(shadow.body->getGravity()));
}

BodySpeeds speeds_of(const ShadowBody& shadow) {
  return {shadow.velocity, shadow.angular_velocity};
}

}  // namespace

void ContactSolver::begin_tick(btDiscreteDynamicsWorld& world, const BoundaryTracker& boundary,
                               const Components& pieces, std::span<const NearBody> near,
                               std::span<const CarriedPiece> carried, Gravity gravity,
                               double tick) {
  gravity_ = gravity;
  shadows_.next_tick();
  boundary_ = &boundary;
  pieces_ = &pieces;
  surface_ = {};  // other points may have become flexible
  std::vector<Obstacle> last_tick = std::exchange(obstacles_, {});
  carried_.assign(carried.begin(), carried.end());
  carried_shadow_.clear();
  substep_ = 0;
  for (const NearBody& body : near) {
    const int shadow = shadows_.shadow_of(*body.object);
    const double way = largest_speed(speeds_of(shadows_[shadow]), *body.object) * tick;
    const Vec3 around = Vec3::Constant(way);
    obstacles_.emplace_back(*body.object, shadow, shadows_[shadow], body.low - around,
                            body.high + around, way, shapes_);
    const auto same = [&](const Obstacle& then) { return &then.object() == body.object; };
    const auto then = std::find_if(last_tick.begin(), last_tick.end(), same);
    if (then != last_tick.end()) obstacles_.back().remember(std::move(*then));
  }
  for (const CarriedPiece& piece : carried_) {
    carried_shadow_.push_back(shadows_.shadow_of(*piece.body));
  }
  const std::vector<SupportContact> contacts =
      gather_support_contacts(*world.getDispatcher(), shadows_);
  supports_ =
      group_support_contacts(contacts, shadows_, touches_beyond(*world.getDispatcher(), shadows_));
  supported_.assign(static_cast<std::size_t>(shadows_.size()), false);
  for (const SupportGroup& group : supports_) {
    if (!group.stands) continue;  // on lattices alone, if anything
    for (const SupportContact& c : group.contacts) supported_[c.a] = supported_[c.b] = true;
  }
  if (gravity_ == Gravity::kToCome) return;
  for (int i = 0; i < shadows_.size(); ++i) {
    const btRigidBody* body = shadows_[i].body;
    if (supported_[i] || !body || !body->isActive()) continue;
    shadows_[i].velocity -= gravity_of(shadows_[i]) * tick;  // it falls anew
  }
}

void ContactSolver::take_over(ContactSolver&& other) {
  for (Obstacle& theirs : other.obstacles_) {
    const auto same = [&](const Obstacle& mine) { return &mine.object() == &theirs.object(); };
    const auto known = std::find_if(obstacles_.begin(), obstacles_.end(), same);
    if (known == obstacles_.end()) {
      obstacles_.push_back(std::move(theirs));
    } else {
      known->add_pairs(std::move(theirs));
    }
  }
}

void ContactSolver::keep(std::size_t piece, std::span<const std::int32_t> points) {
  std::vector<Obstacle> kept;
  for (const Obstacle& obstacle : obstacles_) {
    Obstacle memory = obstacle.memory_of(points);
    if (memory.remembers()) kept.push_back(std::move(memory));
  }
  if (!kept.empty()) kept_[piece] = std::move(kept);
}

std::vector<Obstacle> ContactSolver::give_up(std::size_t piece) {
  const auto known = kept_.find(piece);
  if (known == kept_.end()) return {};
  std::vector<Obstacle> kept = std::move(known->second);
  kept_.erase(known);
  return kept;
}

void ContactSolver::take_up(std::vector<Obstacle> kept) {
  for (Obstacle& obstacle : kept) due_.push_back(std::move(obstacle));
}

void ContactSolver::go_on_with_due(const Lattice& lattice) {
  for (const Obstacle& memory : std::exchange(due_, {})) {
    const auto same = [&](const Obstacle& now) { return &now.object() == &memory.object(); };
    const auto now = std::find_if(obstacles_.begin(), obstacles_.end(), same);
    if (now != obstacles_.end()) now->take_up(memory, lattice, shadows_[now->shadow()]);
  }
}

void ContactSolver::let_go(const btCollisionObject& object) {
  const int i = shadows_.find(object);
  if (i < 0 || !shadows_[i].touched) return;
  shadows_[i].body->setFlags(shadows_[i].flags);
  shadows_[i].touched = false;
}

void ContactSolver::add_forces(Lattice& lattice, double dt) {
  dt_ = dt;
  if (substep_++ % kListInterval == 0) list_pairs(lattice, dt);
  for (const PointLoad& load : loads_) lattice.force[load.point] += load.force;
  const auto serial = std::partition_point(clusters_.begin(), clusters_.end(),
                                           [](const ContactCluster& c) { return c.asks_bullet; });
  for (auto cluster = clusters_.begin(); cluster != serial; ++cluster) press(lattice, *cluster, dt);
  parallel_tasks(clusters_.end() - serial, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) press(lattice, serial[i], dt);
  });
}

void ContactSolver::press(Lattice& lattice, const ContactCluster& cluster, double dt) {
  for (const ContactCluster::Part& part : cluster.parts) {
    Obstacle& obstacle = obstacles_[part.obstacle];
    obstacle.press(lattice, surface_, shadows_[obstacle.shadow()], part.share, dt);
  }
}

void ContactSolver::list_pairs(const Lattice& lattice, double dt) {
  go_on_with_due(lattice);
  double fastest = 0.0;
  for (std::int32_t p : lattice.dynamic_points) {
    fastest = std::max(fastest, lattice.motion[p].velocity.squaredNorm());
  }
  fastest = std::sqrt(fastest);
  if (!surface_.is_of(*boundary_)) surface_ = LatticeSurface(lattice, *boundary_);
  const double time = kListInterval * dt;
  for (Obstacle& obstacle : obstacles_) {
    const ShadowBody& body = shadows_[obstacle.shadow()];
    const double body_speed = largest_speed(speeds_of(body), obstacle.object());
    const double least = (2.0 * body_speed + kPushShare * fastest) * time + kListMargin;
    obstacle.list(lattice, surface_, body, {least, 2.0 * time}, dt);
  }
  clusters_ = contact_clusters(obstacles_, shadows_, *pieces_);
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
    const bool once = supported_[i] || gravity_ == Gravity::kGiven;
    const Vec3 fall = once ? Vec3(Vec3::Zero()) : Vec3(gravity_of(body) * tick);
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

std::vector<ContactSolver::BodyPush> ContactSolver::take_pushes(const Lattice& lattice) {
  std::vector<BodyPush> pushes;
  for (Obstacle& obstacle : obstacles_) {
    for (const ObjectPush& push : obstacle.take_pushes(lattice)) {
      pushes.push_back({&obstacle.object(), push});
    }
  }
  return pushes;
}

std::vector<double> ContactSolver::contact_loads(const Lattice& lattice) const {
  std::vector<double> loads(lattice.motion.size(), 0.0);
  for (const Obstacle& obstacle : obstacles_) obstacle.add_loads(dt_, loads);
  return loads;
}

std::vector<std::uint8_t> ContactSolver::yielding_points(const Lattice& lattice) const {
  std::vector<std::uint8_t> points(lattice.motion.size(), 0);
  for (const Obstacle& obstacle : obstacles_) obstacle.mark_yielding(points);
  return points;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
