#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>

#include "bullet_bridge/body_motion.h"
#include "bullet_bridge/co_simulation_impl.h"
#include "bullet_bridge/conversions.h"
#include "bullet_bridge/neighbourhood.h"
#include "bullet_bridge/waking.h"

// The first half of a tick: Bullet knows the contacts and has not applied an impulse. What is about
// to be loaded becomes a lattice, and the lattices are integrated with the bodies they touch.

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

bool anyone_is_awake(const btCollisionWorld& world) {
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) {
    if (objects[i]->isActive()) return true;
  }
  return false;
}

double mass_of(const btCollisionObject& object) {
  if (!is_movable(object)) return kUnbreakable;
  const btScalar inverse = btRigidBody::upcast(&object)->getInvMass();
  return inverse > 0 ? 1.0 / inverse : kUnbreakable;
}

}  // namespace

void CoSimulation::Impl::before_solve(double dt) {
  in_tick_ = true;
  if (failure_) return;
  lattice_contacts_.clear();
  stepped_lattice_ = stepped_late_ = false;
  broken_in_tick_ = 0;
  break_points_.clear();
  tick_ = dt;
  thawed_in_tick_ = false;
  jointed_ = jointed_bodies(world_);
  sweeping_ = sweeping_bodies(world_, dt);
  index_.begin_tick(pieces_, world_);
  for (Piece* piece : flexible_pieces()) take_changes_of_game(*piece, dt);
  for (Piece* piece : index_.awake()) piece->proxy->remember();
  try {
    if (switching()) {
      thaw_what_will_be_hit(dt);
      thaw_what_lattices_hit(dt);
      clear_unwanted_manifolds();
    }
    blow_on_proxies(dt);
    step_lattices(dt);
    show_velocities(dt);
    joint_loads_.begin(world_, index_);
  } catch (const SimulationError& error) {
    failure_ = error.diagnostic;
  }
}

void CoSimulation::Impl::thaw_what_will_be_hit(double dt) {
  const double share = averaging_share(dt, settings_.switching.load_time);
  // A body at rest receives m g dt a tick, and as much again when its contacts chatter.
  const double weight = 2.0 * world_.getGravity().length() * dt;
  for (Piece* piece : index_.awake()) judge_impulse(*piece, dt, share, weight);
  // Pairs are many; where all sleep none of them meets anew.
  if (anyone_is_awake(world_)) consider_pairs(dt);
  for (const NearBody& mover : sweeping_) consider_sweep(mover, dt);
}

void CoSimulation::Impl::consider_pairs(double dt) {
  const btBroadphasePairArray& pairs = world_.getPairCache()->getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    const auto* a = static_cast<const btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject);
    const auto* b = static_cast<const btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject);
    if (!a->isActive() && !b->isActive()) continue;
    if (Piece* piece = index_.rigid(*a)) consider_pair(*piece, *b, dt);
    if (Piece* piece = index_.rigid(*b)) consider_pair(*piece, *a, dt);
  }
}

// Bullet pairs what sweeps through the world with proxies only when it has reached them.
void CoSimulation::Impl::consider_sweep(const NearBody& mover, double dt) {
  for (const btCollisionObject* met : bodies_in(world_, mover.low, mover.high)) {
    Piece* piece = index_.rigid(*met);
    if (piece && may_meet(world_, *mover.object, *met)) consider_touch(*piece, *mover.object, dt);
  }
}

void CoSimulation::Impl::consider_pair(Piece& piece, const btCollisionObject& other, double dt) {
  if (piece.body().hasContactResponse() && is_met(other)) consider_touch(piece, other, dt);
}

void CoSimulation::Impl::consider_touch(Piece& piece, const btCollisionObject& other, double dt) {
  const double limit = flexible_strain(piece.strength, settings_.switching);
  const btRigidBody& body = piece.proxy->body();
  // Most pairs rest on one another: a bound on the speed spares them the exact query.
  const TickGravity gravity = thawing_late_ ? TickGravity::kGiven : TickGravity::kToCome;
  const double bound = largest_closing_speed(body, piece.proxy->reach(), other, dt, gravity);
  if (bound <= limit * piece.strength.wave_speed) return;
  const double partner = mass_of(other);
  if (impact_strain(piece.strength, bound, partner) <= limit) return;
  std::optional<PredictedTouch> touch = predict_touch(body, other, dt, gravity);
  if (!touch) return;
  if (touch->time == 0.0) swing_round(piece, other, *touch, dt);
  const double strain = impact_strain(piece.strength, touch->closing_speed, partner);
  if (strain <= limit || !material_meets(piece, other, limit, *touch, dt)) return;
  thaw_piece(piece, "touch",
             {{"closing_m_s", touch->closing_speed},
              {"gap_m", touch->gap},
              {"strain", strain},
              {"limit_strain", limit}});
}

// Where two bodies touch already, at an edge it turns about, say, the shortest distance does not
// tell what else is about to strike: points do.
void CoSimulation::Impl::swing_round(const Piece& piece, const btCollisionObject& other,
                                     PredictedTouch& touch, double dt) {
  if (index_.rigid(other)) return;  // material_meets() goes by points alone
  const std::optional<double> speed =
      reaching_speed(piece.proxy->body(), piece.proxy->local(), other, 0.0, dt, shapes_);
  touch.closing_speed = std::max(touch.closing_speed, speed.value_or(0.0));
}

// Hulls are larger than the material in them: does it really meet within the tick? Faces reach
// farther than the points at their corners. Where only the hulls of two proxies meet, Bullet is
// told to let them pass.
bool CoSimulation::Impl::material_meets(Piece& piece, const btCollisionObject& other, double limit,
                                        const PredictedTouch& touch, double dt) {
  const Piece* partner = index_.rigid(other);
  if (!partner) {
    return touch.gap <= 0.0 || reaching_speed(piece.proxy->body(), piece.proxy->local(), other,
                                              piece.face_reach, dt, shapes_);
  }
  piece.proxy->write_points(lattice_, piece.points);
  partner->proxy->write_points(lattice_, partner->points);
  const double closing = closing_speed(lattice_, piece.points, partner->points, dt);
  if (impact_strain(piece.strength, closing, mass_of(other)) > limit) return true;
  passing_.emplace_back(&piece.proxy->body(), &other);
  return false;
}

// What no prediction foresaw, and what builds up slowly: the impulses of the last tick, of contacts
// and of the game's constraints, and the air. What they did when it became rigid is in its shape
// already; more strains it, less relaxes it. `share`: of this tick in the average; `weight`:
// impulse per mass that strains nothing, N s/kg.
void CoSimulation::Impl::judge_impulse(Piece& piece, double dt, double share, double weight) {
  const double contacts = piece.proxy->impulse;
  const double impulse = contacts + piece.joint_load * dt;
  const double limit = flexible_strain(piece.strength, settings_.switching);
  piece.sustained_load += (impulse / dt - piece.sustained_load) * share;
  const double change = std::abs(piece.sustained_load - piece.carried_load) +
                        (piece.air_load - piece.carried_air).norm();
  const double sustained = sustained_strain(piece.strength, change, piece.size);
  const double jump = std::abs(impulse - piece.carried_load * dt) / piece.strength.mass - weight;
  const double sudden = impact_strain(piece.strength, jump, kUnbreakable);
  if (std::max(sustained, sudden) <= limit) return;
  const bool missed = sudden > limit && contacts >= piece.joint_load * dt;
  if (missed) ++counters_.missed;
  thaw_piece(
      piece, missed ? "missed touch" : "sustained load",
      {{"impulse_N_s", impulse}, {"strain", std::max(sustained, sudden)}, {"limit_strain", limit}});
}

// A proxy that a flexible piece is about to hit turns flexible as well; that may reach others.
void CoSimulation::Impl::thaw_what_lattices_hit(double dt) {
  for (std::size_t before = pieces_.size() + 1, now = 0; now != before;) {
    before = flexible_pieces().size();
    for (Piece* flexible : flexible_pieces()) {
      for (const NearBody& body : bodies_near(*flexible, dt)) {
        Piece* proxy = index_.rigid(*body.object);
        if (proxy) consider_lattice_hit(*flexible, *proxy, dt);
      }
    }
    now = flexible_pieces().size();
  }
}

void CoSimulation::Impl::consider_lattice_hit(const Piece& flexible, Piece& piece, double dt) {
  const double limit = flexible_strain(piece.strength, settings_.switching);
  const RigidMotion mine = piece.proxy->motion();
  const RigidMotion other = rigid_motion(lattice_.motion, lattice_.mass, flexible.points);
  const double bound = (mine.velocity - other.velocity).norm() +
                       mine.angular_velocity.norm() * piece.size +
                       other.angular_velocity.norm() * flexible.size +
                       2.0 * rms_vibration(lattice_, flexible.points);
  // What pins hold does not give way, however light it is.
  const double partner = flexible.pinned ? kUnbreakable : flexible.strength.mass;
  if (impact_strain(piece.strength, bound, partner) <= limit) return;
  piece.proxy->write_points(lattice_, piece.points);
  const double closing = closing_speed(lattice_, piece.points, flexible.points, dt);
  const double strain = impact_strain(piece.strength, closing, partner);
  if (strain <= limit) return;
  thaw_piece(piece, "touch",
             {{"closing_m_s", closing}, {"strain", strain}, {"limit_strain", limit}});
}

// A proxy feels the wind that its lattice would.
void CoSimulation::Impl::blow_on_proxies(double dt) {
  const bool still = !environment_.air && !air_before_;
  air_before_ = environment_.air.has_value();
  if (still) return;
  for (const auto& piece : pieces_) {
    if (!piece->proxy || !piece->proxy->feels_air()) continue;
    piece->air_load = environment_.air ? blow_on(*piece, dt) : Vec3(Vec3::Zero());
  }
}

// Returns the force of the air, N, in the body's frame. What fell asleep wakes when the air bears a
// tenth of its weight.
Vec3 CoSimulation::Impl::blow_on(const Piece& piece, double dt) {
  constexpr double kWakingShare = 0.1;
  RigidProxy& proxy = *piece.proxy;
  if (!proxy.body().isActive()) {
    const Vec3 force = proxy.air_force(*environment_.air, time_);
    const double weight = piece.strength.mass * world_.getGravity().length();
    if (force.norm() > kWakingShare * weight) wake(world_, proxy.body());
    if (!proxy.body().isActive()) return force;
    proxy.remember();
  }
  return proxy.feel_air(*environment_.air, time_, dt);
}

void CoSimulation::Impl::thaw_piece(Piece& piece, const std::string& cause, Numbers numbers) {
  if (thawing_late_) {
    numbers.emplace_back("deflected", 1.0);
    contacts_.let_go(piece.proxy->body());
    btRigidBody& body = piece.proxy->body();
    if (!body.getTotalForce().isZero()) {  // Bullet gave it gravity; the lattice falls by itself
      body.setLinearVelocity(body.getLinearVelocity() - body.getGravity() * btScalar(tick_));
    }
  }
  (thawing_late_ ? late_contacts_ : contacts_).take_up(contacts_.give_up(piece.id));
  const HandOver books = thaw(lattice_, piece.points, *piece.proxy);
  switches_.push_back({time_, piece.object, piece.id, cause, std::move(numbers), books});
  ++counters_.to_flexible;
  counters_.stored_J -= piece.stored_J;
  piece.stored_J = 0.0;
  piece.calm_ticks = 0;
  piece.touched = false;
  set_role(piece, PointRole::kDynamic);
  piece.seen =
      std::make_unique<LatticeBody>(lattice_, boundary_, piece.points, std::move(piece.proxy));
  index_.pieces_changed();
  thawed_in_tick_ = true;
  if (!thawing_late_) take_changes_of_game(piece, tick_);  // forces that Bullet has not given yet
}

// Contacts of bodies that are lattices now, and of hulls that may pass.
void CoSimulation::Impl::clear_unwanted_manifolds() {
  if (!thawed_in_tick_ && passing_.empty()) return;
  const auto may_pass = [&](const btCollisionObject* a, const btCollisionObject* b) {
    return std::any_of(passing_.begin(), passing_.end(), [&](const auto& pair) {
      return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
    });
  };
  const auto is_lattice = [&](const btCollisionObject& object) {
    const Piece* piece = index_.any(object);
    return piece && piece->flexible();
  };
  btDispatcher& dispatcher = *world_.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const btCollisionObject* a = manifold.getBody0();
    const btCollisionObject* b = manifold.getBody1();
    if (is_lattice(*a) || is_lattice(*b) || may_pass(a, b)) manifold.clearManifold();
  }
  passing_.clear();
}

void CoSimulation::Impl::set_role(const Piece& piece, PointRole role) {
  for (std::int32_t p : piece.points) lattice_.role[p] = role;
  roles_stale_ = true;
}

void CoSimulation::Impl::refresh_roles(const std::vector<Piece*>& carried) {
  const bool carried_changed = !carried.empty() || !lattice_.carried_points.empty();
  for (std::int32_t p : lattice_.carried_points) {
    if (lattice_.role[p] == PointRole::kCarried) lattice_.role[p] = PointRole::kIdle;
  }
  for (std::size_t i = 0; i < carried.size(); ++i) {
    carried[i]->proxy->write_points(lattice_, carried[i]->points);
    for (std::int32_t p : carried[i]->points) {
      lattice_.role[p] = PointRole::kCarried;
      lattice_.carrier[p] = static_cast<std::int32_t>(i);
    }
  }
  if (roles_stale_) {
    rebuild_active(lattice_);
    time_operator_.roles_changed();
  } else if (carried_changed) {
    rebuild_carried(lattice_);
    time_operator_.carried_changed();
  }
  roles_stale_ = false;
}

// What bounds the step of an implicit object, or of grains, is contact.
void CoSimulation::Impl::refuse_step(double substeps) const {
  const std::size_t hardest = time_operator_.hardest_object().value_or(0);
  const LatticeObject& object = lattice_.objects[hardest];
  const bool contact = time_operator_.is_implicit(hardest) || object.spring_frequency == 0.0;
  throw SimulationError(
      {object.authored.name,
       "a tick would need " + std::to_string(std::llround(std::min(substeps, 1e15))) + " substeps" +
           (contact ? " for its contacts" : ""),
       std::string(contact ? "soften the material, coarsen the lattice or raise most_substeps ("
                           : "soften the material, coarsen the lattice, integrate it implicitly "
                             "or raise most_substeps (") +
           std::to_string(settings_.most_substeps) + ")"});
}

std::vector<NearBody> CoSimulation::Impl::bodies_near(const Piece& piece, double dt) const {
  return bodies_within_reach(world_, sweeping_, lattice_, piece.points, dt);
}

CoSimulation::Impl::Surroundings CoSimulation::Impl::surroundings_of(
    const std::vector<Piece*>& flexible, double dt) const {
  std::vector<NearBody> near;
  for (const Piece* piece : flexible) {
    const std::vector<NearBody> reached = bodies_near(*piece, dt);
    near.insert(near.end(), reached.begin(), reached.end());
  }
  Surroundings surroundings;
  for (const NearBody& body : merged(std::move(near))) {
    Piece* proxy = index_.rigid(*body.object);
    if (proxy) {
      surroundings.carried.push_back(proxy);
    } else {
      surroundings.bodies.push_back(body);
    }
  }
  return surroundings;
}

double CoSimulation::Impl::substeps_wanted(double dt) const {
  return std::ceil(dt / (time_operator_.largest_step() * settings_.step_scale));
}

double CoSimulation::Impl::substeps_wanted_by(std::size_t object, double dt) const {
  return std::ceil(dt / (time_operator_.largest_step_of(object) * settings_.step_scale));
}

int CoSimulation::Impl::substeps_for(double dt) {
  if (substeps_wanted(dt) > settings_.most_substeps) make_stiffest_implicit(dt);
  const double wanted = substeps_wanted(dt);
  if (!(wanted <= settings_.most_substeps)) refuse_step(wanted);  // nor NaN
  return std::max(1, static_cast<int>(wanted));
}

// All that would need too many substeps and may choose by itself.
void CoSimulation::Impl::make_stiffest_implicit(double dt) {
  for (std::size_t o = 0; o < lattice_.objects.size(); ++o) {
    const LatticeObject& object = lattice_.objects[o];
    if (removed_[o]) continue;
    const double wanted = substeps_wanted_by(o, dt);
    if (integration_[o] != Integration::kAutomatic || time_operator_.is_implicit(o)) continue;
    if (!(wanted > settings_.most_substeps)) continue;
    if (object.spring_frequency == 0.0 && object.spring_damping == 0.0) continue;  // grains
    time_operator_.make_implicit(o);
    notes_.push_back({object.authored.name,
                      "a tick would need " + std::to_string(std::llround(std::min(wanted, 1e15))) +
                          " substeps, more than " + std::to_string(settings_.most_substeps) +
                          ": it is integrated implicitly from now on and does not vibrate",
                      "soften the material or coarsen the lattice if it should break on impact"});
  }
}

void CoSimulation::Impl::step_lattices(double dt) {
  const std::vector<Piece*> flexible = flexible_pieces();
  if (flexible.empty()) {
    loads_.clear();
    return contacts_.forget();
  }
  step(flexible, contacts_, ContactSolver::Gravity::kToCome, dt);
}

void CoSimulation::Impl::step(const std::vector<Piece*>& flexible, ContactSolver& contacts,
                              ContactSolver::Gravity gravity, double dt) {
  const Surroundings surroundings = surroundings_of(flexible, dt);
  refresh_roles(surroundings.carried);
  std::vector<CarriedPiece> carried;
  for (const Piece* piece : surroundings.carried) {
    carried.push_back({&piece->proxy->body(), piece->points, piece->proxy->local()});
  }
  contacts.begin_tick(world_, boundary_, time_operator_.pieces(), surroundings.bodies, carried,
                      gravity, dt);
  if (&contacts == &contacts_) gather_loads(dt);
  const int substeps = substeps_for(dt);
  environment_.gravity = from_bullet(world_.getGravity());
  time_operator_.set_time(time_);
  const std::vector<Vec3> before = velocities_of(flexible);
  const StepReport report =
      time_operator_.advance(substeps, dt / substeps, environment_, &contacts);
  contacts.write_velocities(world_, dt);
  follow_parabola(flexible, before, dt / substeps);
  note_contacts(contacts);
  stepped_lattice_ = true;
  note(report);
}

// m/s, of their centres of mass.
std::vector<Vec3> CoSimulation::Impl::velocities_of(const std::vector<Piece*>& pieces) const {
  std::vector<Vec3> velocities;
  for (const Piece* piece : pieces) {
    velocities.push_back(rigid_motion(lattice_.motion, lattice_.mass, piece->points).velocity);
  }
  return velocities;
}

// Semi-implicit Euler, x += v' h, goes a h^2 / 2 too far in every substep: g t h / 2 after a fall
// of t (0.14 mm after 0.45 s at h = 65 us). What nothing touched, and no joint holds, moves as a
// proxy does, x += (v + v') h / 2 (RigidProxy::fly()); what is touched has met others where it was.
void CoSimulation::Impl::follow_parabola(const std::vector<Piece*>& pieces,
                                         const std::vector<Vec3>& before, double substep) {
  const std::vector<Vec3> after = velocities_of(pieces);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = *pieces[i];
    const auto touched = [&](std::int32_t p) { return lattice_.touched[p] != 0; };
    if (piece.pinned || jointed(piece) ||
        std::any_of(piece.points.begin(), piece.points.end(), touched)) {
      continue;
    }
    const Vec3 shift = -0.5 * substep * (after[i] - before[i]);
    for (std::int32_t p : piece.points) lattice_.motion[p].position += shift;
  }
}

// Now: pieces that break take their bodies with them at the tick's end.
void CoSimulation::Impl::note_contacts(ContactSolver& contacts) {
  for (const auto& [body, push] : contacts.take_pushes(lattice_)) {
    LatticeContact contact;
    contact.object = static_cast<std::size_t>(push.object);
    contact.at = push.at;
    contact.impulse = push.impulse;
    if (const Piece* other = index_.any(*body)) {
      contact.other = other->object;
    } else {
      contact.body = body;
    }
    lattice_contacts_.push_back(contact);
  }
}

void CoSimulation::Impl::note(const StepReport& report) {
  broken_in_tick_ += report.broken_edges;
  counters_.spring_updates += report.spring_updates;
  counters_.broken_edges += report.broken_edges;
  for (const BreakEvent& event : report.breaks) {
    const LatticeObject& object = lattice_.objects[event.object];
    breaks_.push_back({event.time,
                       static_cast<std::size_t>(event.object),
                       event.where,
                       event.edge - object.edges.begin,
                       event.cell < 0 ? -1 : event.cell - object.cells.begin,
                       {}});
    break_points_.push_back(lattice_.springs[event.edge].a);
  }
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
