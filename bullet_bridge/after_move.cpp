#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "bullet_bridge/co_simulation_impl.h"
#include "bullet_bridge/conversions.h"

// The second half of a tick: impulses on proxies are read, poses corrected, broken pieces split,
// calm ones frozen.

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// N s, sum of the magnitudes at its points.
double impulse_of(const btPersistentManifold& manifold) {
  double impulse = 0.0;
  for (int c = 0; c < manifold.getNumContacts(); ++c) {
    impulse += manifold.getContactPoint(c).getAppliedImpulse();
  }
  return impulse;
}

}  // namespace

void CoSimulation::Impl::after_solve(double dt) {
  if (!failure_) {
    take_joints(dt);
    read_contacts();
    for (Piece* piece : flexible_pieces()) piece->joint_load = 0.0;
  }
  joint_loads_.end();
  if (failure_ || !switching() || pieces_.empty()) return;
  try {
    catch_up_with_deflected(dt);
  } catch (const SimulationError& error) {
    failure_ = error.diagnostic;
  }
}

// Sleeping proxies keep what they bore when they fell asleep, until something wakes them in the
// tick.
void CoSimulation::Impl::read_contacts() {
  std::vector<Piece*> counted;
  const auto count = [&](Piece* piece, double impulse) {
    if (!piece || !piece->body().isActive()) return;
    if (!piece->counted) {
      piece->proxy->impulse = 0.0;
      piece->counted = true;
      counted.push_back(piece);
    }
    piece->proxy->impulse += impulse;
  };
  for (Piece* piece : index_.awake()) {
    if (!piece->body().isActive()) continue;
    piece->joint_load = 0.0;
    if (!piece->flexible()) count(piece, 0.0);
  }
  if (index_.awake().empty()) return;
  btDispatcher& dispatcher = *world_.getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    if (!manifold.getBody0()->isActive() && !manifold.getBody1()->isActive()) continue;
    Piece* a = index_.rigid(*manifold.getBody0());
    Piece* b = index_.rigid(*manifold.getBody1());
    const double impulse = impulse_of(manifold);
    count(a, impulse);
    count(b, impulse);
  }
  for (Piece* piece : counted) piece->counted = false;
}

void CoSimulation::Impl::after_move(double dt) {
  in_tick_ = false;
  if (failure_) return;
  // Flags of bodies that both have touched: the first has the game's, so it comes last.
  if (stepped_late_) late_contacts_.correct_poses(dt);
  if (stepped_lattice_) contacts_.correct_poses(dt);
  fly_free_proxies(dt);
  time_ += dt;
  if (stepped_lattice_) split_broken_pieces();
  show_lattices();
  name_pieces_of_breaks();
  count_time(dt);  // before freezing: a piece that calms now was a lattice for the whole tick
  if (stepped_lattice_) freeze_calm_pieces(dt);
  step_debris(dt);
}

void CoSimulation::Impl::fly_free_proxies(double dt) {
  for (Piece* piece : index_.awake()) {
    if (piece->flexible() || piece->proxy->impulse > 0.0) continue;
    btRigidBody& body = piece->proxy->body();
    if (!body.isActive() || jointed(*piece)) continue;
    if (stepped_lattice_ && contacts_.touched(body)) continue;
    if (stepped_late_ && late_contacts_.touched(body)) continue;
    piece->proxy->fly(dt);
  }
}

// Single points, and what was part of cells that are all invalid now: crumbs of two or three points
// on a few bonds, which have no volume and no inertia about a line. Points that never had a cell
// are those of a rope, which stays one when it comes off a body.
bool CoSimulation::Impl::becomes_debris(std::span<const std::int32_t> points) const {
  return points.size() == 1 || std::all_of(points.begin(), points.end(), [&](std::int32_t p) {
           bool had_cell = false;
           for (std::int32_t e : lattice_.point_edges[p]) {
             for (std::int32_t c : lattice_.topology.edge_cells[e]) {
               if (lattice_.breaking.cell_valid[c]) return false;
               had_cell = true;
             }
           }
           return had_cell;
         });
}

// P and L stay: the points go on with the velocities they have. Their bonds break.
void CoSimulation::Impl::turn_to_debris(std::span<const std::int32_t> points,
                                        const std::optional<Vec3>& born_in) {
  std::vector<std::int32_t> bonds;
  for (std::int32_t p : points) {
    for (std::int32_t e : lattice_.point_edges[p]) {
      if (!lattice_.breaking.edge_broken[e]) bonds.push_back(e);
    }
    lattice_.role[p] = PointRole::kIdle;
    if (lattice_.inverse_mass[p] == 0.0) continue;  // a pinned one stays where it is
    debris_.add(p, born_in.value_or(lattice_.motion[p].position));
  }
  counters_.particles += points.size();
  const BreakingResult broken = break_edges(lattice_.topology, lattice_.breaking, bonds);
  boundary_.update(lattice_.topology, broken);
  counters_.broken_edges += broken.broken_edges.size();
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
  index_.pieces_changed();
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
    split(*piece, std::move(groups));
    piece->points.clear();
  }
  std::erase_if(pieces_, [](const auto& piece) { return piece->points.empty(); });
  index_.pieces_changed();
  roles_stale_ = true;
}

void CoSimulation::Impl::split(const Piece& piece, std::vector<std::vector<std::int32_t>> groups) {
  SplitRecord record{.time = time_, .object = piece.object, .piece = piece.id};
  const Vec3 middle = rigid_motion(lattice_.motion, lattice_.mass, piece.points).centre;
  const std::optional<std::size_t> heir = heir_among(piece, groups);
  if (!heir) keep_for_joints(piece.object, piece.seen->shared_body());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::vector<std::int32_t>& points = groups[i];
    if (becomes_debris(points)) {
      turn_to_debris(points, middle);
      record.particles += points.size();
    } else {
      Piece& part = add_piece(piece.object, std::move(points));
      part.touched = piece.touched;
      part.seen = std::make_unique<LatticeBody>(
          world_, lattice_, boundary_, part.points,
          heir == i ? piece.seen->shared_body() : std::shared_ptr<PieceBody>());
      record.parts.push_back(part.id);
    }
  }
  splits_.push_back(std::move(record));
}

// A burst has tens of thousands of breaks and a thousand pieces: not each in each.
void CoSimulation::Impl::name_pieces_of_breaks() {
  if (break_points_.empty()) return;
  const std::size_t first = breaks_.size() - break_points_.size();
  std::vector<std::pair<std::int32_t, std::size_t>> broken;  // point, which break
  for (std::size_t i = 0; i < break_points_.size(); ++i) {
    broken.emplace_back(break_points_[i], first + i);
  }
  std::sort(broken.begin(), broken.end());
  const auto from = [&](std::int32_t p) {
    return std::lower_bound(broken.begin(), broken.end(), std::pair(p, std::size_t{0}));
  };
  for (const auto& piece : pieces_) {
    const std::vector<std::int32_t>& points = piece->points;
    const auto begin = from(points.front()), end = from(points.back() + 1);
    if (static_cast<std::size_t>(end - begin) <= points.size()) {
      for (auto b = begin; b != end; ++b) {
        if (!std::binary_search(points.begin(), points.end(), b->first)) continue;
        breaks_[b->second].piece = piece->id;
      }
    } else {
      for (std::int32_t p : points) {
        for (auto b = from(p); b != end && b->first == p; ++b) breaks_[b->second].piece = piece->id;
      }
    }
  }
  break_points_.clear();
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
  if (stepped_late_) contacts_.take_over(std::exchange(late_contacts_, {}));
  const std::vector<std::uint8_t> yielding = contacts_.yielding_points(lattice_);
  const auto yields = [&](std::int32_t p) { return yielding[p] != 0; };
  const std::vector<double> pressed = contacts_.contact_loads(lattice_);
  for (Piece* piece : flexible_pieces()) {
    const Calmness seen = look_at(*piece);
    piece->peak_load = seen.peak_load;
    for (std::int32_t p : piece->points) {
      piece->touched = piece->touched || lattice_.touched[p] != 0;
      lattice_.touched[p] = 0;
      lattice_.peak_load[p] = 0.0;
    }
    if (!switching() || piece->pinned) continue;
    const bool quiet = calm(piece->strength, settings_.switching, seen) &&
                       std::none_of(piece->points.begin(), piece->points.end(), yields);
    piece->calm_ticks = quiet ? piece->calm_ticks + 1 : 0;
    if (piece->calm_ticks <
        calm_ticks_needed(piece->strength, settings_.switching, piece->size, dt, piece->touched)) {
      continue;
    }
    if (!piece->touched) ++counters_.needless;
    contacts_.keep(piece->id, piece->points);
    freeze_piece(*piece, "calm", numbers_of(*piece, seen));
    note_carried_load(*piece, pressed);
    // Bullet gives gravity once per stepSimulation; this body has missed it, should more ticks
    // follow.
    piece->proxy->body().applyGravity();
  }
}

// What it bears as it becomes rigid: only a change of that strains it from now on. Counted as
// Bullet's impulses will be, by magnitude: what lies between a floor and a weight bears both.
// `pressed`: N, shape (P), of its contacts with bodies. The force as a whole is known of the others
// too.
void CoSimulation::Impl::note_carried_load(Piece& piece, std::span<const double> pressed) const {
  const RigidProxy& proxy = *piece.proxy;
  double magnitudes = 0.0;
  for (std::int32_t p : piece.points) magnitudes += pressed[p];
  piece.carried_air =
      environment_.air ? proxy.air_force(*environment_.air, time_) : Vec3(Vec3::Zero());
  piece.air_load = piece.carried_air;
  const double whole = contact_load(lattice_, piece.points, from_bullet(world_.getGravity()),
                                    proxy.to_world(piece.carried_air));
  piece.carried_load = std::max(whole, magnitudes) + piece.joint_load;
  piece.sustained_load = piece.carried_load;
}

void CoSimulation::Impl::freeze_piece(Piece& piece, const std::string& cause, Numbers numbers) {
  const HandOver books = freeze(world_, lattice_, piece.points, piece.proxy,
                                piece.seen ? piece.seen->shared_body() : nullptr);
  piece.seen.reset();
  index_.pieces_changed();
  piece.stored_J = books.elastic_J;
  counters_.stored_J += piece.stored_J;
  ++counters_.to_rigid;
  if (piece.proxy->regularised()) ++counters_.regularised;
  set_role(piece, PointRole::kIdle);
  switches_.push_back({time_, piece.object, piece.id, cause, std::move(numbers), books});
}

void CoSimulation::Impl::step_debris(double dt) {
  if (debris_.size() == 0) return;
  std::unordered_set<const btCollisionObject*> proxies;
  for (const auto& piece : pieces_) {
    if (!piece->flexible()) proxies.insert(&piece->body());
  }
  counters_.retired_mass += debris_.step(world_, lattice_, proxies, dt, settings_.debris_lifetime);
}

void CoSimulation::Impl::count_time(double dt) {
  counters_.mass_seconds += index_.mass(pieces_) * dt;
  for (const Piece* piece : flexible_pieces()) {
    counters_.flexible_mass_seconds += piece->strength.mass * dt;
  }
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
