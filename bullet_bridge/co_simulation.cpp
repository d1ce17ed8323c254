#include "bullet_bridge/co_simulation.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "bullet_bridge/contact_solver.h"
#include "bullet_bridge/conversions.h"
#include "bullet_bridge/debris.h"
#include "bullet_bridge/neighbourhood.h"
#include "bullet_bridge/piece.h"
#include "bullet_bridge/solver_decorator.h"
#include "bullet_bridge/touch_prediction.h"
#include "core/operators/time_operator.h"
#include "core/storage/state_hash.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

using Numbers = std::vector<std::pair<std::string, double>>;

double mass_of(const btCollisionObject& object) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  if (!body || body->isStaticOrKinematicObject() || body->getInvMass() == 0) return kUnbreakable;
  return 1.0 / body->getInvMass();
}

}  // namespace

class CoSimulation::Impl : public TickHooks {
 public:
  Impl(btDiscreteDynamicsWorld& world, const CoSimulationSettings& settings)
      : world_(world), settings_(settings), decorator_(world, *this) {}

  void before_solve(double dt) override;
  void after_solve(double dt) override;
  void after_move(double dt) override;

  std::size_t add(PhysicalModel model);
  void sync_points() const;
  std::vector<std::int32_t> points_of_object(std::size_t object) const;

  btDiscreteDynamicsWorld& world_;
  CoSimulationSettings settings_;
  // Rigid pieces' points are written when somebody asks for them.
  mutable Lattice lattice_;
  TimeOperator time_operator_{lattice_};
  ContactSolver contacts_;
  Debris debris_;
  std::vector<std::unique_ptr<Piece>> pieces_;  // ascending by id
  std::unordered_map<const btCollisionObject*, Piece*> piece_of_;  // look-ups only
  std::vector<std::pair<const btCollisionObject*, const btCollisionObject*>> passing_;
  std::vector<std::unique_ptr<RigidProxy>> thawed_;  // to be removed when bodies have moved
  std::size_t next_piece_ = 0;
  double time_ = 0.0;
  bool roles_stale_ = true;
  bool stepped_lattice_ = false;
  std::size_t broken_in_tick_ = 0;
  std::optional<Diagnostic> failure_;
  Counters counters_;
  std::vector<SwitchRecord> switches_;
  std::vector<BreakRecord> breaks_;

 private:
  // Stages of a tick, in order.
  void thaw_what_will_be_hit(double dt);
  void thaw_what_lattices_hit(double dt);
  void step_lattices(double dt);
  [[noreturn]] void refuse_step(double substeps) const;
  void fly_free_proxies(double dt);
  void split_broken_pieces();
  void freeze_calm_pieces(double dt);
  void step_debris(double dt);
  void count_time(double dt);

  bool switching() const { return settings_.representation == Representation::kSwitching; }
  void consider_touch(Piece& piece, const btCollisionObject& other, double dt);
  void consider_lattice_hit(const Piece& flexible, Piece& proxy, double dt);
  bool material_meets(Piece& piece, const btCollisionObject& other, double limit,
                      const PredictedTouch& touch, double dt);
  void thaw_piece(Piece& piece, const std::string& cause, Numbers numbers);
  void freeze_piece(Piece& piece, const std::string& cause, Numbers numbers);
  void clear_unwanted_manifolds();
  void refresh_roles(const std::vector<Piece*>& carried);
  void set_role(const Piece& piece, PointRole role);
  std::vector<Piece*> flexible_pieces() const;
  std::vector<std::vector<std::int32_t>> connected_groups(const Piece& piece);
  bool becomes_debris(std::size_t object, std::span<const std::int32_t> points) const;
  void turn_to_debris(std::span<const std::int32_t> points);
  Piece& add_piece(std::size_t object, std::vector<std::int32_t> points);
  void judge_impulse(Piece& piece, double dt);
  Calmness look_at(const Piece& piece) const;
  Numbers numbers_of(const Piece& piece, const Calmness& seen) const;

  SolverDecorator decorator_;  // last: attaches when all is ready, detaches first
};

// --- before the solver -------------------------------------------------------------------------

void CoSimulation::Impl::before_solve(double dt) {
  if (failure_) return;
  stepped_lattice_ = false;
  broken_in_tick_ = 0;
  for (const auto& piece : pieces_) {
    if (piece->proxy) piece->proxy->remember();
  }
  try {
    if (switching()) {
      thaw_what_will_be_hit(dt);
      thaw_what_lattices_hit(dt);
      clear_unwanted_manifolds();
    }
    step_lattices(dt);
  } catch (const SimulationError& error) {
    failure_ = error.diagnostic;
  }
}

void CoSimulation::Impl::thaw_what_will_be_hit(double dt) {
  for (const auto& piece : pieces_) {
    if (piece->proxy) judge_impulse(*piece, dt);
  }
  const btBroadphasePairArray& pairs =
      world_.getPairCache()->getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    const auto* a = static_cast<const btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject);
    const auto* b = static_cast<const btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject);
    if (!a->hasContactResponse() || !b->hasContactResponse()) continue;
    const auto piece_a = piece_of_.find(a), piece_b = piece_of_.find(b);
    if (piece_a != piece_of_.end()) consider_touch(*piece_a->second, *b, dt);
    if (piece_b != piece_of_.end()) consider_touch(*piece_b->second, *a, dt);
  }
}

void CoSimulation::Impl::consider_touch(Piece& piece, const btCollisionObject& other, double dt) {
  if (piece.flexible()) return;
  const double limit = flexible_strain(piece.strength, settings_.switching);
  const double partner = mass_of(other);
  const btRigidBody& body = piece.proxy->body();
  // Most pairs rest on one another: a bound on the speed spares them the exact query.
  const double bound = largest_closing_speed(body, other, dt);
  if (impact_strain(piece.strength, bound, partner) <= limit) return;
  const std::optional<PredictedTouch> touch = predict_touch(body, other, dt);
  if (!touch) return;
  const double strain = impact_strain(piece.strength, touch->closing_speed, partner);
  if (strain <= limit || !material_meets(piece, other, limit, *touch, dt)) return;
  thaw_piece(piece, "touch",
             {{"closing_m_s", touch->closing_speed},
              {"gap_m", touch->gap},
              {"strain", strain},
              {"limit_strain", limit}});
}

// Hulls are larger than the material in them, and the prediction allows for turning: do points really
// meet within the tick? Where only the hulls of two proxies do, Bullet is told to let them pass.
bool CoSimulation::Impl::material_meets(Piece& piece, const btCollisionObject& other, double limit,
                                        const PredictedTouch& touch, double dt) {
  const auto partner = piece_of_.find(&other);
  if (partner == piece_of_.end()) {
    return touch.gap <= 0.0 || !other.getCollisionShape()->isConvex() ||
           points_reach(piece.proxy->body(), piece.proxy->local(), other, dt);
  }
  piece.proxy->write_points(lattice_, piece.points);
  partner->second->proxy->write_points(lattice_, partner->second->points);
  const double closing = closing_speed(lattice_, piece.points, partner->second->points, dt);
  if (impact_strain(piece.strength, closing, mass_of(other)) > limit) return true;
  passing_.emplace_back(&piece.proxy->body(), &other);
  return false;
}

// What no prediction foresaw, and what builds up slowly: the impulses of the last tick. What its
// contacts bore when it became rigid is in its shape already; more strains it, less relaxes it.
void CoSimulation::Impl::judge_impulse(Piece& piece, double dt) {
  const double impulse = piece.proxy->impulse;
  const double limit = flexible_strain(piece.strength, settings_.switching);
  piece.sustained_load = averaged_load(piece.sustained_load, impulse / dt, dt,
                                       settings_.switching.load_time);
  const double change = std::abs(piece.sustained_load - piece.carried_load);
  const double sustained = sustained_strain(piece.strength, change, piece.size);
  // A body at rest receives m g dt a tick, and as much again when its contacts chatter.
  const double weight = 2.0 * world_.getGravity().length() * dt;
  const double jump = std::max(0.0, impulse / piece.strength.mass - weight);
  const double sudden = impact_strain(piece.strength, jump, kUnbreakable);
  if (std::max(sustained, sudden) <= limit) return;
  if (sudden > limit) ++counters_.missed;
  thaw_piece(piece, sudden > limit ? "missed touch" : "sustained load",
             {{"impulse_N_s", impulse}, {"strain", std::max(sustained, sudden)},
              {"limit_strain", limit}});
}

// A proxy that a flexible piece is about to hit turns flexible as well; that may reach others.
void CoSimulation::Impl::thaw_what_lattices_hit(double dt) {
  for (std::size_t before = pieces_.size() + 1, now = 0; now != before;) {
    before = flexible_pieces().size();
    for (Piece* flexible : flexible_pieces()) {
      for (const auto* body : bodies_within_reach(world_, lattice_, flexible->points, dt)) {
        const auto found = piece_of_.find(body);
        if (found != piece_of_.end()) consider_lattice_hit(*flexible, *found->second, dt);
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
  if (impact_strain(piece.strength, bound, flexible.strength.mass) <= limit) return;
  piece.proxy->write_points(lattice_, piece.points);
  const double closing = closing_speed(lattice_, piece.points, flexible.points, dt);
  const double strain = impact_strain(piece.strength, closing, flexible.strength.mass);
  if (strain <= limit) return;
  thaw_piece(piece, "touch",
             {{"closing_m_s", closing}, {"strain", strain}, {"limit_strain", limit}});
}

void CoSimulation::Impl::thaw_piece(Piece& piece, const std::string& cause, Numbers numbers) {
  const HandOver books = thaw(lattice_, piece.points, *piece.proxy);
  switches_.push_back({time_, piece.object, piece.id, cause, std::move(numbers), books});
  ++counters_.to_flexible;
  counters_.stored_J -= piece.stored_J;
  piece.stored_J = 0.0;
  piece.calm_ticks = 0;
  piece.touched = false;
  set_role(piece, PointRole::kDynamic);
  // The body leaves the world when bodies may be removed; until then nothing collides with it.
  btRigidBody& body = piece.proxy->body();
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  piece_of_.erase(&body);
  thawed_.push_back(std::move(piece.proxy));
}

// Contacts of bodies that are lattices now, and of hulls that may pass.
void CoSimulation::Impl::clear_unwanted_manifolds() {
  if (thawed_.empty() && passing_.empty()) return;
  const auto may_pass = [&](const btCollisionObject* a, const btCollisionObject* b) {
    return std::any_of(passing_.begin(), passing_.end(), [&](const auto& pair) {
      return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
    });
  };
  btDispatcher& dispatcher = *world_.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const btCollisionObject* a = manifold.getBody0();
    const btCollisionObject* b = manifold.getBody1();
    if (!a->hasContactResponse() || !b->hasContactResponse() || may_pass(a, b)) {
      manifold.clearManifold();
    }
  }
  passing_.clear();
}

void CoSimulation::Impl::set_role(const Piece& piece, PointRole role) {
  for (std::int32_t p : piece.points) lattice_.role[p] = role;
  roles_stale_ = true;
}

std::vector<Piece*> CoSimulation::Impl::flexible_pieces() const {
  std::vector<Piece*> flexible;
  for (const auto& piece : pieces_) {
    if (piece->flexible()) flexible.push_back(piece.get());
  }
  return flexible;
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

void CoSimulation::Impl::refuse_step(double substeps) const {
  const auto stiffest = std::min_element(
      lattice_.objects.begin(), lattice_.objects.end(),
      [](const auto& a, const auto& b) { return a.largest_step < b.largest_step; });
  throw SimulationError({stiffest->authored.name,
                         "a tick would need " + std::to_string(std::llround(substeps)) + " substeps",
                         "soften the material, coarsen the lattice or raise most_substeps (" +
                             std::to_string(settings_.most_substeps) + ")"});
}

void CoSimulation::Impl::step_lattices(double dt) {
  const std::vector<Piece*> flexible = flexible_pieces();
  if (flexible.empty()) return;
  std::vector<const btCollisionObject*> near;
  for (Piece* piece : flexible) {
    const auto reached = bodies_within_reach(world_, lattice_, piece->points, dt);
    near.insert(near.end(), reached.begin(), reached.end());
  }
  const auto by_index = [](const btCollisionObject* a, const btCollisionObject* b) {
    return a->getWorldArrayIndex() < b->getWorldArrayIndex();
  };
  std::sort(near.begin(), near.end(), by_index);
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::vector<const btCollisionObject*> bodies;
  std::vector<Piece*> carried;
  for (const btCollisionObject* object : near) {
    const auto found = piece_of_.find(object);
    if (found == piece_of_.end()) bodies.push_back(object);
    if (found != piece_of_.end()) carried.push_back(found->second);
  }
  refresh_roles(carried);
  std::vector<CarriedPiece> carried_views;
  for (Piece* piece : carried) {
    carried_views.push_back({&piece->proxy->body(), piece->points, piece->proxy->local()});
  }
  contacts_.begin_tick(world_, lattice_, bodies, carried_views);

  const double wanted = std::ceil(dt / (time_operator_.largest_step() * settings_.step_scale));
  if (wanted > settings_.most_substeps) refuse_step(wanted);
  const int substeps = std::max(1, static_cast<int>(wanted));
  const StepReport report = time_operator_.advance(substeps, dt / substeps,
                                                   from_bullet(world_.getGravity()), &contacts_);
  contacts_.write_velocities(world_, dt);
  stepped_lattice_ = true;
  broken_in_tick_ = report.broken_edges;
  counters_.spring_updates += report.spring_updates;
  counters_.broken_edges += report.broken_edges;
  for (const BreakEvent& event : report.breaks) {
    const auto object = static_cast<std::size_t>(
        lattice_.point_object[lattice_.springs[event.edge].a]);
    breaks_.push_back({time_ + event.time, object, event.where});
  }
}

// --- after the solver --------------------------------------------------------------------------

void CoSimulation::Impl::after_solve(double) {
  for (const auto& piece : pieces_) {
    if (piece->proxy) piece->proxy->impulse = 0.0;
  }
  btDispatcher& dispatcher = *world_.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    double impulse = 0.0;
    for (int c = 0; c < manifold.getNumContacts(); ++c) {
      impulse += manifold.getContactPoint(c).getAppliedImpulse();
    }
    for (const btCollisionObject* body : {manifold.getBody0(), manifold.getBody1()}) {
      const auto found = piece_of_.find(body);
      if (found != piece_of_.end()) found->second->proxy->impulse += impulse;
    }
  }
}

// --- after bodies moved ------------------------------------------------------------------------

void CoSimulation::Impl::after_move(double dt) {
  if (failure_) return;
  if (stepped_lattice_) contacts_.correct_poses(dt);
  fly_free_proxies(dt);
  thawed_.clear();
  if (stepped_lattice_) {
    split_broken_pieces();
    freeze_calm_pieces(dt);
  }
  step_debris(dt);
  time_ += dt;
  count_time(dt);
}

void CoSimulation::Impl::fly_free_proxies(double dt) {
  for (const auto& piece : pieces_) {
    if (!piece->proxy || piece->proxy->impulse > 0.0) continue;
    btRigidBody& body = piece->proxy->body();
    if (!body.isActive() || body.getNumConstraintRefs() > 0) continue;
    if (stepped_lattice_ && contacts_.touched(body)) continue;
    piece->proxy->fly(dt);
  }
}

// Single points, and in an object made of cells what holds no valid cell any more: crumbs of two or
// three points on a few bonds, which have no volume and no inertia about a line.
bool CoSimulation::Impl::becomes_debris(std::size_t object,
                                        std::span<const std::int32_t> points) const {
  if (points.size() == 1) return true;
  if (lattice_.objects[object].cells.size() == 0) return false;
  return std::none_of(points.begin(), points.end(), [&](std::int32_t p) {
    const auto edges = lattice_.point_edges[p];
    return std::any_of(edges.begin(), edges.end(), [&](std::int32_t e) {
      const auto cells = lattice_.topology.edge_cells[e];
      return std::any_of(cells.begin(), cells.end(),
                         [&](std::int32_t c) { return lattice_.breaking.cell_valid[c] != 0; });
    });
  });
}

// P and L stay: the points go on with the velocities they have. Their bonds break.
void CoSimulation::Impl::turn_to_debris(std::span<const std::int32_t> points) {
  std::vector<std::int32_t> bonds;
  for (std::int32_t p : points) {
    for (std::int32_t e : lattice_.point_edges[p]) {
      if (!lattice_.breaking.edge_broken[e]) bonds.push_back(e);
    }
    lattice_.role[p] = PointRole::kIdle;
    debris_.add(p);
  }
  counters_.broken_edges +=
      break_edges(lattice_.topology, lattice_.breaking, bonds).broken_edges.size();
}

std::vector<std::vector<std::int32_t>> CoSimulation::Impl::connected_groups(const Piece& piece) {
  const Components& all = time_operator_.pieces();
  std::vector<std::vector<std::int32_t>> groups;
  std::unordered_map<std::int32_t, std::size_t> group_of_label;
  for (std::int32_t p : piece.points) {
    const auto [found, fresh] = group_of_label.try_emplace(all.label[p], groups.size());
    if (fresh) groups.emplace_back();
    groups[found->second].push_back(p);
  }
  return groups;
}

Piece& CoSimulation::Impl::add_piece(std::size_t object, std::vector<std::int32_t> points) {
  auto piece = std::make_unique<Piece>();
  piece->id = next_piece_++;
  piece->object = object;
  piece->points = std::move(points);
  measure(*piece, lattice_);
  pieces_.push_back(std::move(piece));
  return *pieces_.back();
}

void CoSimulation::Impl::split_broken_pieces() {
  if (broken_in_tick_ == 0) return;
  for (Piece* piece : flexible_pieces()) {
    std::vector<std::vector<std::int32_t>> groups = connected_groups(*piece);
    if (groups.size() == 1) {
      measure(*piece, lattice_);  // it may have lost its weakest springs
      continue;
    }
    const bool touched = piece->touched;
    piece->points.clear();
    for (std::vector<std::int32_t>& points : groups) {
      if (becomes_debris(piece->object, points)) {
        turn_to_debris(points);
      } else {
        add_piece(piece->object, std::move(points)).touched = touched;
      }
    }
  }
  std::erase_if(pieces_, [](const auto& piece) { return piece->points.empty(); });
  roles_stale_ = true;
}

Calmness CoSimulation::Impl::look_at(const Piece& piece) const {
  Calmness seen;
  for (std::int32_t p : piece.points) {
    seen.peak_load = std::max(seen.peak_load, lattice_.peak_load[p]);
  }
  seen.peak_load_before = piece.peak_load;
  seen.rms_vibration = rms_vibration(lattice_, piece.points);
  return seen;
}

Numbers CoSimulation::Impl::numbers_of(const Piece& piece, const Calmness& seen) const {
  return {{"peak_load", seen.peak_load},
          {"vibration_strain", vibration_strain(piece.strength, seen.rms_vibration)},
          {"limit_strain", 0.5 * flexible_strain(piece.strength, settings_.switching)}};
}

void CoSimulation::Impl::freeze_calm_pieces(double dt) {
  for (Piece* piece : flexible_pieces()) {
    const Calmness seen = look_at(*piece);
    piece->peak_load = seen.peak_load;
    for (std::int32_t p : piece->points) {
      piece->touched = piece->touched || lattice_.touched[p] != 0;
      lattice_.touched[p] = 0;
      lattice_.peak_load[p] = 0.0;
    }
    if (!switching()) continue;
    const bool quiet = calm(piece->strength, settings_.switching, seen);
    piece->calm_ticks = quiet ? piece->calm_ticks + 1 : 0;
    if (piece->calm_ticks < calm_ticks_needed(piece->strength, settings_.switching, piece->size,
                                              dt, piece->touched)) {
      continue;
    }
    if (!piece->touched) ++counters_.needless;
    piece->carried_load =
        contact_load(lattice_, piece->points, from_bullet(world_.getGravity()));
    piece->sustained_load = piece->carried_load;
    freeze_piece(*piece, "calm", numbers_of(*piece, seen));
    // Bullet gives gravity once per stepSimulation; this body has missed it, should more ticks follow.
    piece->proxy->body().applyGravity();
  }
}

void CoSimulation::Impl::freeze_piece(Piece& piece, const std::string& cause, Numbers numbers) {
  const HandOver books = freeze(world_, lattice_, piece.points, piece.proxy);
  piece_of_[&piece.proxy->body()] = &piece;
  piece.stored_J = books.elastic_J;
  counters_.stored_J += piece.stored_J;
  ++counters_.to_rigid;
  set_role(piece, PointRole::kIdle);
  switches_.push_back({time_, piece.object, piece.id, cause, std::move(numbers), books});
}

void CoSimulation::Impl::step_debris(double dt) {
  if (debris_.size() == 0) return;
  std::unordered_set<const btCollisionObject*> proxies;
  for (const auto& [body, piece] : piece_of_) proxies.insert(body);
  debris_.step(world_, lattice_, proxies, dt);
}

void CoSimulation::Impl::count_time(double dt) {
  for (const auto& piece : pieces_) {
    counters_.mass_seconds += piece->strength.mass * dt;
    // Flexible in this tick: a piece frozen just now was integrated as a lattice.
    if (piece->flexible()) counters_.flexible_mass_seconds += piece->strength.mass * dt;
  }
}

// --- adding and reading ------------------------------------------------------------------------

std::size_t CoSimulation::Impl::add(PhysicalModel model) {
  const std::size_t object = add_object(lattice_, std::move(model));
  rebuild_active(lattice_);
  time_operator_.roles_changed();
  Piece whole;
  whole.object = object;
  whole.points = points_of_object(object);
  for (std::vector<std::int32_t>& points : connected_groups(whole)) {
    if (becomes_debris(object, points)) {
      turn_to_debris(points);
      continue;
    }
    Piece& piece = add_piece(object, std::move(points));
    const Calmness seen = look_at(piece);
    const bool rigid = settings_.representation == Representation::kAlwaysRigid ||
                       (switching() && calm(piece.strength, settings_.switching, seen));
    if (rigid) freeze_piece(piece, "start", numbers_of(piece, seen));
  }
  roles_stale_ = true;
  return object;
}

void CoSimulation::Impl::sync_points() const {
  for (const auto& piece : pieces_) {
    if (piece->proxy) piece->proxy->write_points(lattice_, piece->points);
  }
}

std::vector<std::int32_t> CoSimulation::Impl::points_of_object(std::size_t object) const {
  const IdRange<PointId>& range = lattice_.objects[object].points;
  std::vector<std::int32_t> points;
  for (std::int32_t p = range.begin; p < range.end; ++p) points.push_back(p);
  return points;
}

// --- the facade --------------------------------------------------------------------------------

CoSimulation::CoSimulation(btDiscreteDynamicsWorld& world, const CoSimulationSettings& settings)
    : impl_(std::make_unique<Impl>(world, settings)) {}

CoSimulation::~CoSimulation() = default;

std::size_t CoSimulation::add(PhysicalModel model) { return impl_->add(std::move(model)); }

PhysicalModel CoSimulation::model(std::size_t object) const {
  impl_->sync_points();
  return extract_model(impl_->lattice_, object);
}

const std::optional<Diagnostic>& CoSimulation::failure() const { return impl_->failure_; }

std::size_t CoSimulation::object_count() const { return impl_->lattice_.objects.size(); }

std::vector<PieceView> CoSimulation::pieces() const {
  impl_->sync_points();
  std::vector<PieceView> views;
  for (const auto& piece : impl_->pieces_) {
    PieceView view;
    view.object = piece->object;
    view.flexible = piece->flexible();
    view.motion = rigid_motion(impl_->lattice_.motion, impl_->lattice_.mass, piece->points);
    const std::int32_t first = impl_->lattice_.objects[piece->object].points.begin;
    for (std::int32_t p : piece->points) view.points.push_back(p - first);
    views.push_back(std::move(view));
  }
  return views;
}

double CoSimulation::debris_mass(std::size_t object) const {
  double mass = 0.0;
  for (std::int32_t p : impl_->points_of_object(object)) mass += impl_->lattice_.mass[p];
  for (const auto& piece : impl_->pieces_) {
    if (piece->object == object) mass -= piece->strength.mass;
  }
  return mass;
}

std::vector<bool> CoSimulation::flexible_points(std::size_t object) const {
  const IdRange<PointId>& range = impl_->lattice_.objects[object].points;
  std::vector<bool> flexible(range.size(), false);
  for (const auto& piece : impl_->pieces_) {
    if (piece->object != object || !piece->flexible()) continue;
    for (std::int32_t p : piece->points) flexible[static_cast<std::size_t>(p - range.begin)] = true;
  }
  return flexible;
}

std::pair<Mat3, Vec3> CoSimulation::placement(std::size_t object) const {
  impl_->sync_points();
  const Lattice& lattice = impl_->lattice_;
  const std::vector<std::int32_t> points = impl_->points_of_object(object);
  return {best_rotation(lattice.motion, lattice.authored_position, lattice.mass, points),
          rigid_motion(lattice.motion, lattice.mass, points).centre};
}

const Counters& CoSimulation::counters() const { return impl_->counters_; }
const std::vector<SwitchRecord>& CoSimulation::switches() const { return impl_->switches_; }
const std::vector<BreakRecord>& CoSimulation::breaks() const { return impl_->breaks_; }

std::uint64_t CoSimulation::state_hash() const {
  impl_->sync_points();
  const Lattice& lattice = impl_->lattice_;
  StateHash hash;
  hash.add(std::span<const PointMotion>(lattice.motion));
  hash.add(std::span<const std::uint8_t>(lattice.breaking.edge_broken));
  hash.add(std::span<const std::uint8_t>(lattice.breaking.cell_valid));
  hash.add(std::span<const PointRole>(lattice.role));
  for (int i = 0; i < impl_->world_.getNumCollisionObjects(); ++i) {
    const btCollisionObject* object = impl_->world_.getCollisionObjectArray()[i];
    const btTransform& pose = object->getWorldTransform();
    for (int k = 0; k < 3; ++k) {
      hash.add(pose.getOrigin()[k]);
      for (int l = 0; l < 3; ++l) hash.add(pose.getBasis()[k][l]);
    }
    const btRigidBody* body = btRigidBody::upcast(object);
    if (!body) continue;
    for (int k = 0; k < 3; ++k) {
      hash.add(body->getLinearVelocity()[k]);
      hash.add(body->getAngularVelocity()[k]);
    }
  }
  return hash.value();
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
