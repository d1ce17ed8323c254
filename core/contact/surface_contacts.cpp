#include "core/contact/surface_contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/contact/bearing_contact.h"

namespace limber {
namespace {

// Refreshes between two looks at the surface while things break. What breaking uncovers is a cell
// away from what was across it.
constexpr int kBrokenInterval = 8;

// Of 4 / dt^2, the limit of an explicit step: the automatic step leaves 0.15 of it beyond springs
// and point-point contacts (kStepSafety of lattice.cpp), of which friction takes a twentieth.
constexpr double kStepShare = 0.1;

bool is_present(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
                std::int32_t face) {
  const std::int32_t corner = surface.corners(face)[0];
  const PointRole a = lattice.role[point], b = lattice.role[corner];
  return lattice.breaking.face_external[face] && a != PointRole::kIdle && b != PointRole::kIdle &&
         (a == PointRole::kDynamic || b == PointRole::kDynamic);
}

struct ByPoint {
  bool operator()(const SurfaceContacts::Held& h, std::int32_t p) const { return h.point < p; }
  bool operator()(std::int32_t p, const SurfaceContacts::Held& h) const { return p < h.point; }
};

}  // namespace

void SurfaceContacts::refresh(const Lattice& lattice, const Components& pieces,
                              bool topology_changed, bool carried_changed) {
  const bool breaking = broken_ && ++refreshes_since_break_ >= kBrokenInterval;
  if (!started_ || topology_changed || carried_changed || breaking) {
    rebuild_surface(lattice, pieces);
  }
}

void SurfaceContacts::rebuild_surface(const Lattice& lattice, const Components& pieces) {
  surface_.rebuild(lattice, pieces);
  std::erase_if(
      held_, [&](const Held& h) { return !is_present(lattice, surface_, h.point, h.place.face); });
  previous_.resize(lattice.motion.size());
  is_watched_.resize(lattice.motion.size(), 0);
  shares_.resize(lattice.motion.size(), 0);
  started_ = rebuilt_ = true;
  broken_ = false;
  refreshes_since_break_ = 0;
}

// What passed a face in the other's last substep is held as well.
void SurfaceContacts::take_over(SurfaceContacts&& other, const Lattice& lattice) {
  other.find_passages(lattice);
  held_.insert(held_.end(), other.held_.begin(), other.held_.end());
  std::stable_sort(held_.begin(), held_.end(),
                   [](const Held& l, const Held& r) { return l.point < r.point; });
}

void SurfaceContacts::add_forces(Lattice& lattice, double dt) {
  near_.advance(dt);
  find_passages(lattice);
  if (rebuilt_ || near_.is_due()) {
    near_.refresh(lattice, surface_, rebuilt_, dt);
    if (rebuilt_) hold_what_is_inside(lattice);
    rebuilt_ = false;
    watch_awake(lattice);
  }
  if (held_.empty()) return;
  follow(lattice);
  count_shares();
  for (Held& held : held_) push(lattice, held, dt);
  for (const Held& held : held_) {
    shares_[held.point] = 0;
    for (std::int32_t p : surface_.corners(held.place.face)) shares_[p] = 0;
  }
}

// ---- passages ----------------------------------------------------------------------------------

void SurfaceContacts::find_passages(const Lattice& lattice) {
  if (watched_.empty()) return;
  passages_.clear();
  find_passages_of(lattice, near_.awake_between(), false);
  find_passages_of(lattice, near_.awake_within(), true);
  if (!passages_.empty()) take_hold();
  remember_positions(lattice);
}

void SurfaceContacts::find_passages_of(const Lattice& lattice, const NearFaces::Pairs& pairs,
                                       bool within) {
  for (const NearFaces::Pair& pair : pairs) {
    if (!(within ? near_.may_touch_within(pair) : near_.may_touch_between(pair))) continue;
    if (!lattice.breaking.face_external[pair.face]) continue;
    const auto& [a, b, c] = surface_.corners(pair.face);
    const Triangle from = {previous_[a], previous_[b], previous_[c]};
    const Crossings found = crossings(previous_[pair.point], lattice.motion[pair.point].position,
                                      from, surface_.triangle(lattice, pair.face));
    for (int i = 0; i < found.count; ++i) {
      passages_.push_back({pair.point, found.at[i].time, pair.face, found.at[i].from_front});
    }
  }
}

void SurfaceContacts::remember_positions(const Lattice& lattice) {
  for (std::int32_t p : watched_) previous_[p] = lattice.motion[p].position;
}

void SurfaceContacts::watch_awake(const Lattice& lattice) {
  for (std::int32_t p : watched_) is_watched_[p] = 0;
  watched_.clear();
  const auto watch = [&](std::int32_t p) {
    if (!is_watched_[p]) watched_.push_back(p);
    is_watched_[p] = 1;
  };
  for (const NearFaces::Pairs* pairs : {&near_.awake_between(), &near_.awake_within()}) {
    for (const NearFaces::Pair& pair : *pairs) {
      watch(pair.point);
      for (std::int32_t p : surface_.corners(pair.face)) watch(p);
    }
  }
  remember_positions(lattice);
}

void SurfaceContacts::take_hold() {
  std::sort(passages_.begin(), passages_.end(), [](const Passage& l, const Passage& r) {
    return std::tie(l.point, l.time, l.face) < std::tie(r.point, r.time, r.face);
  });
  for (const Passage& passage : passages_) {
    const auto here = std::equal_range(held_.begin(), held_.end(), passage.point, ByPoint{});
    if (is_known(passage, {here.first, here.second})) continue;
    if (!surface_.is_sheet(passage.face) && !passage.from_front) continue;  // it leaves a solid
    Held held;
    held.point = passage.point;
    held.place.face = passage.face;
    held.place.side = passage.from_front ? 1.0 : -1.0;
    held_.insert(here.second, held);
  }
}

// A point that is held here already is on its way about its edges or back. One that is held at a
// solid's face and leaves the solid elsewhere, as through the back of a plate, has not got away:
// and when it comes in again there, nothing new has happened.
bool SurfaceContacts::is_known(const Passage& passage, std::span<Held> held_here) {
  const std::int32_t group = surface_.group_of_face(passage.face);
  Held* behind_back = nullptr;
  for (Held& held : held_here) {
    if (surface_.adjacent(held.place.face, passage.face)) return true;
    if (surface_.is_sheet(passage.face) || surface_.is_sheet(held.place.face)) continue;
    if (surface_.group_of_face(held.place.face) == group) behind_back = &held;
  }
  if (!behind_back) return false;
  if (!passage.from_front) {
    ++behind_back->exits;
    return true;
  }
  if (behind_back->exits == 0) return false;
  --behind_back->exits;
  return true;
}

// ---- points that were inside from the start ----------------------------------------------------

// By the nearest face of each other piece, where the nearest place lies within that face: at edges
// and corners that one face does not tell. Only where the pair is new: what was listed before came
// in with everybody watching.
void SurfaceContacts::hold_what_is_inside(const Lattice& lattice) {
  const NearFaces::Pairs& all = near_.listed_between();
  const auto by_point = [](const NearFaces::Pair& pair, std::int32_t p) { return pair.point < p; };
  std::vector<Held> found;
  for (const NearFaces::Pair& fresh : near_.new_between()) {
    const std::int32_t group = surface_.group_of_face(fresh.face);
    if (surface_.is_sheet(fresh.face)) continue;
    const auto first = std::lower_bound(all.begin(), all.end(), fresh.point, by_point);
    const auto last = std::lower_bound(first, all.end(), fresh.point + 1, by_point);
    HeldPlace place;
    if (!is_inside(lattice, {first, last}, group, place) || place.face != fresh.face) continue;
    const bool known = std::any_of(held_.begin(), held_.end(), [&](const Held& h) {
      return h.point == fresh.point && surface_.group_of_face(h.place.face) == group;
    });
    if (known) continue;
    Held held;
    held.point = fresh.point;
    held.place = place;
    held.offset = place.distance;
    found.push_back(held);
  }
  held_.insert(held_.end(), found.begin(), found.end());
  std::stable_sort(held_.begin(), held_.end(),
                   [](const Held& l, const Held& r) { return l.point < r.point; });
}

bool SurfaceContacts::is_inside(const Lattice& lattice,
                                std::span<const NearFaces::Pair> pairs_of_point, std::int32_t group,
                                HeldPlace& place) const {
  place.distance = std::numeric_limits<double>::infinity();
  for (const NearFaces::Pair& pair : pairs_of_point) {
    if (surface_.group_of_face(pair.face) != group || surface_.is_sheet(pair.face)) continue;
    const HeldPlace here = place_against(lattice, surface_, pair.point, pair.face, 1.0);
    if (here.distance < place.distance) place = here;
  }
  return place.within && place.height < 0.0;
}

// ---- forces ------------------------------------------------------------------------------------

void SurfaceContacts::follow(const Lattice& lattice) {
  for (Held& held : held_) {
    if (held.books.open) {
      held.books.settle(-separation_speed(held.contact, motion_of(lattice, held)));
    }
    held.released = !is_present(lattice, surface_, held.point, held.place.face);
    if (held.released) continue;
    held.place = followed(lattice, surface_, held.point, held.place);
    held.released = is_released(surface_, held.place);
  }
  std::erase_if(held_, [](const Held& held) { return held.released; });
}

void SurfaceContacts::count_shares() {
  for (const Held& held : held_) {
    ++shares_[held.point];
    for (std::int32_t p : surface_.corners(held.place.face)) ++shares_[p];
  }
}

PenaltyContact SurfaceContacts::law_of(const Lattice& lattice, const Held& held, double dt) const {
  const std::int32_t corner = surface_.corners(held.place.face)[0];
  const LatticeObject& a = lattice.objects[lattice.point_object[held.point]];
  const LatticeObject& b = lattice.objects[lattice.point_object[corner]];
  PenaltyContact law;
  const bool repel = a.contact_frequency > 0.0 && b.contact_frequency > 0.0;
  law.frequency = repel ? 2.0 * std::sqrt(kStepShare) / dt : 0.0;
  law.restitution = a.authored.object.restitution * b.authored.object.restitution;
  law.friction = a.authored.object.friction * b.authored.object.friction;
  return law;
}

FaceMotion SurfaceContacts::motion_of(const Lattice& lattice, const Held& held) const {
  const auto& [a, b, c] = surface_.corners(held.place.face);
  return {lattice.motion[held.point].velocity,
          {lattice.motion[a].velocity, lattice.motion[b].velocity, lattice.motion[c].velocity}};
}

// By the forces summed so far.
FaceMotion SurfaceContacts::motion_after(const Lattice& lattice, const Held& held,
                                         double dt) const {
  const auto& [a, b, c] = surface_.corners(held.place.face);
  return {velocity_after(lattice, held.point, dt),
          {velocity_after(lattice, a, dt), velocity_after(lattice, b, dt),
           velocity_after(lattice, c, dt)}};
}

FaceMobility SurfaceContacts::mobility_of(const Lattice& lattice, const Held& held) const {
  const auto of = [&](std::int32_t p) { return shares_[p] * lattice.inverse_mass[p]; };
  const auto& [a, b, c] = surface_.corners(held.place.face);
  return {of(held.point), {of(a), of(b), of(c)}};
}

void SurfaceContacts::push(Lattice& lattice, Held& held, double dt) {
  const FaceContact contact = contact_of(lattice, surface_, held.point, held.place);
  const FaceMotion motion = motion_of(lattice, held);
  const FaceMobility mobility = mobility_of(lattice, held);
  const PenaltyContact law = law_of(lattice, held, dt);
  PassiveContact& books = held.books;
  books.share_mass(contact_mass(contact, mobility));
  if (std::isinf(books.mass)) return;
  Approach at;
  at.depth = eased(contact.depth, held.offset, dt);
  at.closing = -separation_speed(contact, motion);
  at.foreseen = -separation_speed(contact, motion_after(lattice, held, dt));
  at.foreseeable = !is_implicit(lattice, held.point) &&
                   !is_implicit(lattice, surface_.corners(held.place.face)[0]);
  at.easing = held.offset > 0.0;
  const double press = bear(books, law, at, dt / books.mass, dt);
  held.contact = contact;
  if (press <= 0.0) return;
  FaceForces forces = push_apart(contact, press);
  if (law.friction > 0.0 && held.place.within) {
    const auto gradients = weight_gradients(surface_.triangle(lattice, held.place.face));
    forces += friction_across(contact, motion, mobility, gradients, law.friction * press, dt);
  }
  lattice.force[held.point] += forces.on_point;
  lattice.touched[held.point] = 1;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t corner = surface_.corners(held.place.face)[i];
    lattice.force[corner] += forces.on_corners[i];
    lattice.touched[corner] = 1;
  }
}

}  // namespace limber
