#include "core/contact/point_contacts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/contact/piece_boxes.h"
#include "core/contact/point_grid.h"

namespace limber {
namespace {

// Two points of one object never collide at more than this share of their authored distance: an
// undamaged shape is free of contact.
constexpr double kAuthoredDistanceShare = 0.9;

// The list's skin as a share of the largest contact radius: a wider one lists more pairs, a
// narrower one lists more often. 2 was the cheapest on a breaking teapot (1, 2, 3 and 4 tried).
constexpr double kSkinRadii = 2.0;

// A point that has no edge from the start: it has no shape to keep.
bool is_grain(const Lattice& lattice, std::int32_t p) { return lattice.point_edges[p].empty(); }

PenaltyContact law_between(const LatticeObject& a, const LatticeObject& b) {
  PenaltyContact law;
  law.frequency = std::min(a.contact_frequency, b.contact_frequency);
  law.restitution = a.authored.object.restitution * b.authored.object.restitution;
  return law;
}

// Two points that touch.
struct Touch {
  double depth = 0.0;  // m
  Vec3 normal;         // unit, from a to b
};

std::optional<Touch> touch_of(const Lattice& lattice, const PointContacts::Pair& pair) {
  const Vec3 d = lattice.motion[pair.b].position - lattice.motion[pair.a].position;
  const double squared = d.squaredNorm();
  if (squared >= pair.contact_distance * pair.contact_distance || squared == 0.0) return {};
  const double distance = std::sqrt(squared);
  return Touch{pair.contact_distance - distance, d / distance};
}

void push_apart(Lattice& lattice, const PointContacts::Pair& pair, const Vec3& force) {
  lattice.force[pair.b] += force;
  lattice.force[pair.a] -= force;
  lattice.touched[pair.a] = lattice.touched[pair.b] = 1;
}

void press(Lattice& lattice, const PointContacts::Pair& pair) {
  const std::optional<Touch> touch = touch_of(lattice, pair);
  if (!touch) return;
  const Vec3 w = lattice.motion[pair.b].velocity - lattice.motion[pair.a].velocity;
  push_apart(lattice, pair,
             penalty_force(pair.law, pair.reduced_mass, touch->depth, w.dot(touch->normal)) *
                 touch->normal);
}

// 1/kg. A body that carries a point weighs more than that.
double mobility(const Lattice& lattice, std::int32_t p) {
  return lattice.role[p] == PointRole::kDynamic ? lattice.inverse_mass[p] : 0.0;
}

void bear_pair(Lattice& lattice, PointContacts::Pair& pair, double dt) {
  if (is_implicit(lattice, pair.a) || is_implicit(lattice, pair.b)) return press(lattice, pair);
  const std::optional<Touch> touch = touch_of(lattice, pair);
  const bool bore = std::exchange(pair.bears, touch.has_value());
  if (!touch) return;
  const Vec3& n = touch->normal;
  const double now = (lattice.motion[pair.b].velocity - lattice.motion[pair.a].velocity).dot(n);
  const double surprise = bore ? now - pair.expected : 0.0;
  const double foreseen =
      (velocity_after(lattice, pair.b, dt) - velocity_after(lattice, pair.a, dt)).dot(n);
  const double gain = dt * (mobility(lattice, pair.a) + mobility(lattice, pair.b));
  const double push =
      bearing_force(pair.law, pair.reduced_mass, touch->depth, foreseen + surprise, gain, dt);
  pair.expected = foreseen + push * gain;
  push_apart(lattice, pair, push * n);
}

// Refreshes between two looks at how far pieces have deformed.
constexpr int kDeformationCheckInterval = 16;

// Refreshes between two listings within pieces while things break: the ends of an edge that has
// just broken are a tenth of its length from contact, which takes them tens of substeps.
constexpr int kWithinInterval = 4;

bool by_points(const PointContacts::Pair& l, const PointContacts::Pair& r) {
  return l.a != r.a ? l.a < r.a : l.b < r.b;
}

double largest_radius(const Lattice& lattice, const std::vector<std::int32_t>& points) {
  double radius = 0.0;
  for (std::int32_t p : points) radius = std::max(radius, lattice.contact_radius[p]);
  return radius;
}

std::vector<std::int32_t> all_points(const Lattice& lattice) {
  std::vector<std::int32_t> points = lattice.dynamic_points;
  points.insert(points.end(), lattice.carried_points.begin(), lattice.carried_points.end());
  std::sort(points.begin(), points.end());
  return points;
}

}  // namespace

void PointContacts::Listing::remember(const Lattice& lattice, std::vector<std::int32_t> of) {
  points = std::move(of);
  at.clear();
  for (std::int32_t p : points) at.push_back(lattice.motion[p].position);
}

void PointContacts::refresh(const Lattice& lattice, const Components& pieces, bool topology_changed,
                            bool carried_changed) {
  merge_fresh();
  if (topology_changed || carried_changed) {
    pieces_ = with_carriers(lattice, pieces);
    skin_ = kSkinRadii * largest_radius(lattice, all_points(lattice));
  }
  if (skin_ == 0.0) return;
  if (topology_changed || carried_changed || moved_too_far(lattice)) list_between(lattice);
  within_stale_ =
      within_stale_ || topology_changed ||
      (refreshes_ % kDeformationCheckInterval == 0 && deformed_too_far(lattice, pieces));
  if (within_stale_ && refreshes_ % kWithinInterval == 0) list_within(lattice);
  ++refreshes_;
}

// However far apart they are: a pair out of reach exerts nothing and is gone with the next listing,
// but one out of reach today may have been nearer when the list was made, and the list has to bear
// the deformation since then.
void PointContacts::edges_broken(const Lattice& lattice, std::span<const std::int32_t> edges) {
  if (skin_ == 0.0) return;  // nothing is listed yet, or no point has a contact radius
  for (std::int32_t e : edges) {
    const auto [p, q] = std::minmax(lattice.springs[e].a, lattice.springs[e].b);
    if (lattice.role[p] == PointRole::kDynamic) fresh_.push_back(make_pair(lattice, p, q));
  }
}

void PointContacts::take_over(PointContacts&& other) {
  merge_fresh();
  other.merge_fresh();
  const auto join = [](Pairs& mine, const Pairs& theirs) {
    const auto listed = static_cast<std::ptrdiff_t>(mine.size());
    mine.insert(mine.end(), theirs.begin(), theirs.end());
    std::inplace_merge(mine.begin(), mine.begin() + listed, mine.end(), by_points);
  };
  join(between_, other.between_);
  join(within_, other.within_);
  skin_ = std::max(skin_, other.skin_);
}

void PointContacts::merge_fresh() {
  if (fresh_.empty()) return;
  const auto listed = static_cast<std::ptrdiff_t>(within_.size());
  std::sort(fresh_.begin(), fresh_.end(), by_points);
  within_.insert(within_.end(), fresh_.begin(), fresh_.end());
  std::inplace_merge(within_.begin(), within_.begin() + listed, within_.end(), by_points);
  fresh_.clear();
}

bool PointContacts::moved_too_far(const Lattice& lattice) const {
  const Listing& then = between_listing_;
  if (then.points.empty()) return false;
  // A common translation changes no distance, so that falling together keeps the list.
  const Vec3 common = lattice.motion[then.points.front()].position - then.at.front();
  double largest = 0.0;
  for (std::size_t i = 0; i < then.points.size(); ++i) {
    const Vec3 moved = lattice.motion[then.points[i]].position - then.at[i] - common;
    largest = std::max(largest, moved.squaredNorm());
  }
  return largest > 0.25 * skin_ * skin_;
}

bool PointContacts::deformed_too_far(const Lattice& lattice, const Components& pieces) const {
  std::vector<Vec3> listed(lattice.motion.size());
  for (std::size_t i = 0; i < within_listing_.points.size(); ++i) {
    listed[within_listing_.points[i]] = within_listing_.at[i];
  }
  for (const std::vector<std::int32_t>& points : points_of(pieces)) {
    if (points.size() == 1) continue;  // a grain has no shape
    const Mat3 rotation = best_rotation(lattice.motion, listed, lattice.mass, points);
    const Vec3 anchor = lattice.motion[points[0]].position;
    for (std::int32_t p : points) {
      const Vec3 rigid = anchor + rotation * (listed[p] - listed[points[0]]);
      const Vec3 moved = lattice.motion[p].position - rigid;
      if (moved.squaredNorm() > 0.25 * skin_ * skin_) return true;
    }
  }
  return false;
}

// Only points inside another piece's box can meet a point of it.
std::vector<std::int32_t> PointContacts::points_near_other_pieces(const Lattice& lattice) const {
  std::vector<std::int32_t> points = all_points(lattice);
  if (!PieceBoxes::pay(pieces_.count, points.size())) return points;
  const PieceBoxes boxes(lattice, points, pieces_, skin_ + 2.0 * skin_ / kSkinRadii);
  std::erase_if(points, [&](std::int32_t p) {
    const Vec3& x = lattice.motion[p].position;
    return !boxes.reaches_into_another(Box3(x, x), pieces_.label[p]);
  });
  return points;
}

template <class Accept>
PointContacts::Pairs PointContacts::near_pairs(const Lattice& lattice,
                                               const std::vector<std::int32_t>& points,
                                               Accept accept) const {
  Pairs pairs;
  std::vector<Vec3> at;
  for (std::int32_t p : points) at.push_back(lattice.motion[p].position);
  // A pair is needed as soon as both may have come skin / 2 nearer.
  const PointGrid grid(at, skin_ + 2.0 * skin_ / kSkinRadii);
  grid.for_each_near_pair([&](std::int32_t i, std::int32_t j) {
    const std::int32_t p = std::min(points[i], points[j]), q = std::max(points[i], points[j]);
    const double reach = lattice.contact_radius[p] + lattice.contact_radius[q] + skin_;
    if ((at[i] - at[j]).squaredNorm() > reach * reach || !accept(p, q)) return;
    pairs.push_back(make_pair(lattice, p, q));
  });
  std::sort(pairs.begin(), pairs.end(), by_points);
  return pairs;
}

void PointContacts::list_between(const Lattice& lattice) {
  between_listing_.remember(lattice, all_points(lattice));
  old_between_.swap(between_);
  // Two carried points belong to rigid bodies: their own engine's business.
  between_ =
      near_pairs(lattice, points_near_other_pieces(lattice), [&](std::int32_t p, std::int32_t q) {
        return pieces_.label[p] != pieces_.label[q] &&
               (lattice.role[p] == PointRole::kDynamic || lattice.role[q] == PointRole::kDynamic);
      });
  // A piece may have split between two points of it: they are in the list above now.
  std::erase_if(within_,
                [&](const Pair& pair) { return pieces_.label[pair.a] != pieces_.label[pair.b]; });
}

void PointContacts::list_within(const Lattice& lattice) {
  within_stale_ = false;
  within_listing_.remember(lattice, lattice.dynamic_points);
  old_within_.swap(within_);
  within_ = near_pairs(lattice, lattice.dynamic_points, [&](std::int32_t p, std::int32_t q) {
    return pieces_.label[p] == pieces_.label[q] && !joined(lattice, p, q);
  });
}

PointContacts::Pair PointContacts::make_pair(const Lattice& lattice, std::int32_t p,
                                             std::int32_t q) const {
  const std::int32_t object_p = lattice.point_object[p], object_q = lattice.point_object[q];
  double distance = lattice.contact_radius[p] + lattice.contact_radius[q];
  if (object_p == object_q && !is_grain(lattice, p) && !is_grain(lattice, q)) {
    const Vec3 authored = lattice.authored_position[q] - lattice.authored_position[p];
    distance = std::min(distance, kAuthoredDistanceShare * authored.norm());
  }
  Pair pair;
  pair.a = p;
  pair.b = q;
  const Pair* then = known(p, q);
  pair.contact_distance = eased_contact_distance(lattice, then, p, q, distance);
  if (then) {
    pair.expected = then->expected;
    pair.bears = then->bears;
  }
  pair.reduced_mass = lattice.mass[p] * lattice.mass[q] / (lattice.mass[p] + lattice.mass[q]);
  pair.law = law_between(lattice.objects[object_p], lattice.objects[object_q]);
  return pair;
}

const PointContacts::Pair* PointContacts::known(std::int32_t p, std::int32_t q) const {
  for (const Pairs* old : {&old_between_, &old_within_, &within_}) {
    const auto found = std::lower_bound(
        old->begin(), old->end(), std::pair(p, q),
        [](const Pair& pair, const auto& key) { return std::pair(pair.a, pair.b) < key; });
    if (found != old->end() && found->a == p && found->b == q) return &*found;
  }
  return nullptr;
}

// A pair that is listed for the first time while it overlaps (a piece thawed inside another one)
// starts without force: its contact distance is what it finds, and grows back as the two separate.
double PointContacts::eased_contact_distance(const Lattice& lattice, const Pair* then,
                                             std::int32_t p, std::int32_t q,
                                             double contact_distance) const {
  const double now = (lattice.motion[q].position - lattice.motion[p].position).norm();
  if (now >= contact_distance) return contact_distance;
  return then ? std::max(then->contact_distance, now) : now;
}

void PointContacts::add_forces(Lattice& lattice) const {
  for (const Pairs* pairs : {&between_, &within_, &fresh_}) {
    for (const Pair& pair : *pairs) press(lattice, pair);
  }
}

void PointContacts::bear(Lattice& lattice, double dt) {
  for (Pairs* pairs : {&between_, &within_, &fresh_}) {
    for (Pair& pair : *pairs) bear_pair(lattice, pair, dt);
  }
}

}  // namespace limber
