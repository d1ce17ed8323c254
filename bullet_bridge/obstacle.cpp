#include "bullet_bridge/obstacle.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "bullet_bridge/shapes/face_penetration.h"
#include "core/contact/bearing_contact.h"
#include "core/contact/triangle.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// A contact is soft, as the point-point penalty, to this share of the point's contact radius (times
// sqrt(S) for a softened object). There it stops what its springs do not hold (light points under a
// heavy thing), or, where the speed after the substep is not foreseen, is as stiff from there on as
// this share of the step's limit, 4 / dt^2, allows. The automatic step leaves 0.15 of it beyond
// springs and point-point contact; contact with faces of lattices takes 0.1, friction 0.05 of what
// is left when all meet at one point.
constexpr double kSoftShare = 0.4;
constexpr double kDeepStepShare = 0.03;

// And to this share of the part's own thickness: from half of it on a rod or a plate would be left
// on the far side.
constexpr double kThinShare = 0.1;
constexpr double kThinMost = 0.4;  // softened or not

// What all contacts of a body may take together of the step's limit on the body's side.
constexpr double kBodyStepShare = 0.05;

// A body that is farther from where it was than twice the way of its own speed, and by this, has
// been put there: m, what Bullet's own mending of overlaps moves it in a tick at most.
constexpr double kPutMargin = 0.01;

// The deepest place of a face is looked for to this share of the face's size: the force then is
// wrong by as much as a tenth of a millimetre of depth on a face of 10 cm.
constexpr double kDepthTolerance = 1e-3;

// At rest a contact bears its whole elastic force. One that bears less than this share of it, is
// deeper than what comes out in a tick of 1/60 s, m, and does come out, at a tenth at least of the
// speed at which it may, is on its way out. What its books keep from pressing lies still, for ever.
constexpr double kBearingShare = 0.5;
constexpr double kComingShare = 0.1;
constexpr double kLeastYielding = kYieldSpeed / 60.0;

// A piece that was rigid meanwhile still lies where it lay if it is no higher above the surface, m
// (Bullet's rest is within 1 mm; what is bent does not lie on all of its points), and has not slid
// by more.
constexpr double kStillLies = 0.003;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

PenaltyContact law_between(const LatticeObject& object, const btCollisionObject& body) {
  const ObjectAttributes& attributes = object.authored.object;
  PenaltyContact law;
  law.frequency = object.contact_frequency;
  law.restitution = attributes.restitution * body.getRestitution();
  law.friction = attributes.friction * body.getFriction();
  return law;
}

// What counts as deeper than it is comes down to the surface, if it stands off it.
void come_down(Vec3& shift, double depth, double dt) {
  const double reach = shift.norm();
  if (reach <= depth) return;
  shift *= 1.0 - std::min(kEaseSpeed * dt, reach - depth) / reach;
}

double thickness(const ContactPart& part) {  // m
  if (part.kind == ContactPart::Kind::kTriangles) return kNoLimit;
  return (part.own_high - part.own_low).minCoeff();
}

// m: the face does not touch before a corner has moved so far. Bullet's general query is no bound.
double clearance(const ContactPart& part, const FacePenetration& deepest, const PointTrack& track) {
  if (track.inside || part.kind == ContactPart::Kind::kConvex) return 0.0;
  return std::max(0.0, -deepest.bound - 2.0 * part.tolerance);
}

bool may_touch(const ContactPart& part, const Vec3& local, double reach) {
  return within_reach(part, local, reach) && penetration(part, local).depth >= -reach;
}

// A plane is met by points first. Triangles have no depth that deepest_place() could look for: what
// stands out of them is cut out as parts of its own.
bool fits_between_points(const ContactPart& part) {
  return part.kind != ContactPart::Kind::kPlane && part.kind != ContactPart::Kind::kTriangles;
}

// The pairs of one point or face after the other, which are asked for in ascending order.
template <class P>
class KnownPairs {
 public:
  explicit KnownPairs(std::span<const P> ascending) : rest_(ascending) {}

  std::span<const P> of(std::int32_t point_or_face) {
    const auto before = [&](const P& pair) { return pair.of < point_or_face; };
    const auto here = [&](const P& pair) { return pair.of == point_or_face; };
    rest_ = {std::find_if_not(rest_.begin(), rest_.end(), before), rest_.end()};
    return {rest_.begin(), std::find_if_not(rest_.begin(), rest_.end(), here)};
  }

 private:
  std::span<const P> rest_;
};

template <class P>
const P* with_part(std::span<const P> pairs, std::int64_t part) {
  const auto found =
      std::find_if(pairs.begin(), pairs.end(), [&](const P& pair) { return pair.part == part; });
  return found == pairs.end() ? nullptr : &*found;
}

template <class P>
bool is_held(const P* pair) {
  return pair && pair->track.inside && pair->holds;
}

double depth_of(const PointTrack& track) {  // m, when it was followed last; where inside
  return track.level - track.normal.dot(track.last);
}

int revision_of(const btCollisionShape& shape) {
  if (!shape.isCompound()) return 0;
  return static_cast<const btCompoundShape&>(shape).getUpdateRevision();
}

// Velocity of the lattice over the body at a place, m/s.
template <class Place>
Vec3 slip_at(const Lattice& lattice, const ShadowBody& body, const Place& place) {
  return place.velocity(lattice) - body.velocity_at(place.position(lattice));
}

// A body presses a lattice from outside: the far skin of a thin wall is out of its reach, and what
// it would push further out is the near one's business. At rims the body touches across the
// surface's normal; from 30 degrees on it is behind it. `outwards`: the lattice's own, of any
// length, zero where it has none.
bool is_behind(const Vec3& contact_normal, const Vec3& outwards) {
  return contact_normal.dot(outwards) > 0.5 * outwards.norm();
}

// A spike's sides are next to all of it, but they are no way out for a face that it has pierced:
// that has to go back across itself. What it runs along is led out by the nearest side.
void hold_across(const ContactPart& part, const Vec3& area, PointTrack& track) {
  if (!track.inside) return;
  const Vec3 facing = part.direction_from_part_frame(part.facing);
  const double along = area.dot(facing);
  if (std::abs(along) > 0.5 * area.norm() * facing.norm()) {
    track.normal = std::copysign(1.0, along) * area.normalized();
  }
}

// The sides of a sharp corner that are not triangles of the mesh.
bool is_within_body(const ContactPart& part, const Vec3& normal) {
  return part.for_faces && part.direction_to_part_frame(normal).dot(part.facing) <= 0.0;
}

}  // namespace

Vec3 PointPlace::velocity_after(const Lattice& lattice, double dt) const {
  return limber::velocity_after(lattice, point, dt);
}

void PointPlace::add_force(Lattice& lattice, const Vec3& force) const {
  lattice.force[point] += force;
  lattice.touched[point] = 1;
}

Vec3 FacePlace::position(const Lattice& lattice) const {
  Vec3 sum = weights[0] * lattice.motion[corners[0]].position;
  for (int i = 1; i < 3; ++i) sum += weights[i] * lattice.motion[corners[i]].position;
  return sum;
}

Vec3 FacePlace::velocity(const Lattice& lattice) const {
  Vec3 sum = weights[0] * lattice.motion[corners[0]].velocity;
  for (int i = 1; i < 3; ++i) sum += weights[i] * lattice.motion[corners[i]].velocity;
  return sum;
}

Vec3 FacePlace::velocity_after(const Lattice& lattice, double dt) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < 3; ++i) sum += weights[i] * limber::velocity_after(lattice, corners[i], dt);
  return sum;
}

double FacePlace::inverse_mass(const Lattice& lattice) const {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += weights[i] * weights[i] * lattice.inverse_mass[corners[i]];
  return sum;
}

void FacePlace::add_force(Lattice& lattice, const Vec3& force) const {
  for (int i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    lattice.force[corners[i]] += weights[i] * force;
    lattice.touched[corners[i]] = 1;
  }
}

Obstacle::Obstacle(const btCollisionObject& object, int shadow, const ShadowBody& body,
                   const Vec3& low, const Vec3& high, double way, ShapeCache& cache)
    : object_(&object),
      shadow_(shadow),
      shape_(object.getCollisionShape()),
      shape_revision_(revision_of(*object.getCollisionShape())),
      position_(body.position),
      rotation_(body.rotation),
      way_(way),
      at_rest_(!body.movable() && !body.moves()) {
  const Mat3 to_body = body.rotation.transpose();
  const Vec3 middle = to_body * (0.5 * (low + high) - body.position);
  const Vec3 half = to_body.cwiseAbs() * (0.5 * (high - low));
  parts_ = contact_parts(*object.getCollisionShape(), middle - half, middle + half, cache);
  if (!at_rest_) return;
  for (ContactPart& part : parts_) part = placed(part, body.position, body.rotation);
}

void Obstacle::remember(Obstacle&& last_tick) {
  sharers_ = last_tick.sharers_;
  if (shape_ != last_tick.shape_ || shape_revision_ != last_tick.shape_revision_) return;
  const bool both_at_rest = at_rest_ && last_tick.at_rest_;
  const bool turned = rotation_ != last_tick.rotation_;
  const double moved = (position_ - last_tick.position_).norm();
  if (moved > 2.0 * (way_ + last_tick.way_) + kPutMargin || (both_at_rest && turned)) return;
  points_ = std::move(last_tick.points_);
  faces_ = std::move(last_tick.faces_);
  if (at_rest_ == last_tick.at_rest_) return;
  const auto turned_shift = [&](const Vec3& shift) -> Vec3 {
    return at_rest_ ? Vec3(rotation_ * shift) : Vec3(rotation_.transpose() * shift);
  };
  for (PointPair& pair : points_) {
    change_frame(pair.track);
    pair.shift = turned_shift(pair.shift);
  }
  for (FacePair& pair : faces_) {
    change_frame(pair.track);
    pair.shift = turned_shift(pair.shift);
    for (int i = 0; i < 3; ++i) {
      pair.last.col(i) = at_rest_ ? Vec3(position_ + rotation_ * pair.last.col(i))
                                  : Vec3(rotation_.transpose() * (pair.last.col(i) - position_));
    }
  }
}

void Obstacle::add_pairs(Obstacle&& others) {
  if (shape_ != others.shape_ || at_rest_ != others.at_rest_) return;
  const auto join = [](auto& mine, auto& theirs) {
    const auto middle = static_cast<std::ptrdiff_t>(mine.size());
    mine.insert(mine.end(), theirs.begin(), theirs.end());
    std::inplace_merge(mine.begin(), mine.begin() + middle, mine.end(),
                       [](const auto& a, const auto& b) { return a.of < b.of; });
  };
  join(points_, others.points_);
  join(faces_, others.faces_);
}

Obstacle Obstacle::memory_of(std::span<const std::int32_t> points) const {
  Obstacle memory = *this;
  memory.parts_.clear();
  // What is deeper than contacts let in has come there by another way, as a face that lies beside a
  // box's edge is held by its side.
  const auto bears = [&](const auto& pair, std::int32_t point) {
    return is_held(&pair) && depth_of(pair.track) <= pair.law.soft_depth &&
           std::binary_search(points.begin(), points.end(), point);
  };
  std::erase_if(memory.points_, [&](const PointPair& pair) { return !bears(pair, pair.of); });
  std::erase_if(memory.faces_, [&](const FacePair& pair) { return !bears(pair, pair.corners[0]); });
  return memory;
}

void Obstacle::take_up(const Obstacle& memory, const Lattice& lattice, const ShadowBody& body) {
  if (shape_ != memory.shape_ || shape_revision_ != memory.shape_revision_) return;
  if (at_rest_ != memory.at_rest_) return;
  sharers_ = std::max(sharers_, memory.sharers_);
  for (PointPair pair : memory.points_) {
    lie_again(pair, to_frame(body, lattice.motion[pair.of].position), points_);
  }
  for (FacePair pair : memory.faces_) {
    const Mat3 corners = corners_in_frame(lattice, body, pair.corners);
    lie_again(pair, corners * pair.pressed.weights, faces_);
  }
}

// `real`: where the place is that counted as being at track.last.
template <class P>
void Obstacle::lie_again(P& pair, const Vec3& real, std::vector<P>& pairs) const {
  PointTrack& track = pair.track;
  const Vec3 moved = track.last - real;
  const double along = std::min(0.0, moved.dot(track.normal));
  const bool slid = (moved - moved.dot(track.normal) * track.normal).norm() > kStillLies;
  if (slid || track.normal.dot(real) - track.level > kStillLies) return;
  pair.shift = along * track.normal;
  track.last = real + pair.shift;
  // Who put the piece on the surface has lifted its load: what the contact had taken in is spent.
  pair.books = {.mass = pair.books.mass};
  pair.friction.force.setZero();
  pair.yields = false;
  const auto after =
      std::upper_bound(pairs.begin(), pairs.end(), pair.of,
                       [](std::int32_t of, const P& other) { return of < other.of; });
  pairs.insert(after, pair);
}

// A body that stops is met in the world from now on, one that starts to move in its own frame.
void Obstacle::change_frame(PointTrack& track) const {
  if (at_rest_) {
    track.last = position_ + rotation_ * track.last;
    track.normal = rotation_ * track.normal;
    track.level += track.normal.dot(position_);
  } else {
    track.level -= track.normal.dot(position_);
    track.last = rotation_.transpose() * (track.last - position_);
    track.normal = rotation_.transpose() * track.normal;
  }
}

Vec3 Obstacle::to_frame(const ShadowBody& body, const Vec3& point) const {
  if (at_rest_) return point;
  return body.rotation.transpose() * (point - body.position);
}

Vec3 Obstacle::direction_to_frame(const ShadowBody& body, const Vec3& direction) const {
  return at_rest_ ? direction : Vec3(body.rotation.transpose() * direction);
}

Mat3 Obstacle::corners_in_frame(const Lattice& lattice, const ShadowBody& body,
                                const std::array<std::int32_t, 3>& corners) const {
  Mat3 columns;
  for (int i = 0; i < 3; ++i) columns.col(i) = to_frame(body, lattice.motion[corners[i]].position);
  return columns;
}

void Obstacle::list(const Lattice& lattice, const LatticeSurface& surface, const ShadowBody& body,
                    const ListingReach& reach, double dt) {
  gather_pushes(lattice, points_);
  gather_pushes(lattice, faces_);
  list_points(lattice, body, reach, dt);
  list_faces(lattice, surface, body, reach, dt);
  if (points_.empty() && faces_.empty()) sharers_ = 1;
}

// From the pairs, before they are listed anew.
template <class P>
void Obstacle::gather_pushes(const Lattice& lattice, std::vector<P>& pairs) {
  for (P& pair : pairs) {
    const double pushed = std::exchange(pair.pushed, 0.0);
    if (pushed <= 0.0) continue;
    const std::int32_t object = lattice.point_object[pair.pressed.lawgiver()];
    auto sum = std::lower_bound(pushes_.begin(), pushes_.end(), object,
                                [](const ObjectPush& p, std::int32_t o) { return p.object < o; });
    if (sum == pushes_.end() || sum->object != object)
      sum = pushes_.insert(sum, {.object = object});
    sum->impulse += pushed;
    if (pushed <= sum->hardest) continue;
    sum->hardest = pushed;
    sum->at = pair.pressed.position(lattice);
  }
}

std::vector<ObjectPush> Obstacle::take_pushes(const Lattice& lattice) {
  gather_pushes(lattice, points_);
  gather_pushes(lattice, faces_);
  return std::exchange(pushes_, {});
}

bool Obstacle::asks_bullet() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const ContactPart& part) {
    return part.kind == ContactPart::Kind::kConvex;
  });
}

void Obstacle::count_pairs(std::span<const std::int32_t> label_of_point,
                           std::vector<std::size_t>& pairs) const {
  for (const PointPair& pair : points_) ++pairs[label_of_point[pair.of]];
  for (const FacePair& pair : faces_) ++pairs[label_of_point[pair.corners[0]]];
}

void Obstacle::share_out(std::span<const std::int32_t> label_of_point,
                         std::span<const std::int32_t> share_of_label,
                         std::vector<ObstacleShare>& shares) const {
  const auto share_of = [&](std::int32_t point) -> ObstacleShare& {
    return shares[share_of_label[label_of_point[point]]];
  };
  for (std::size_t i = 0; i < points_.size(); ++i) {
    share_of(points_[i].of).points.push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    share_of(faces_[i].corners[0]).faces.push_back(static_cast<std::int32_t>(i));
  }
}

// What is found inside without having come in starts without force (a proxy that thaws where its
// hull touches): the depth it has counts as surface until it has left.
template <class P>
P Obstacle::known_or_new(const P* known, std::int32_t of, std::size_t listed,
                         const Vec3& local) const {
  P pair;
  if (known) {
    pair = *known;
  } else {
    pair.of = of;
    pair.part = parts_[listed].id;
    pair.track = start_track(parts_[listed], local);
    pair.offset = std::max(0.0, penetration(parts_[listed], local).depth);
  }
  pair.listed = listed;
  return pair;
}

// What is held stays listed wherever it is: that it has come past a thin part, or under a surface
// without an inside, its place does not tell.
void Obstacle::list_points(const Lattice& lattice, const ShadowBody& body,
                           const ListingReach& reach, double dt) {
  const std::vector<PointPair> old = std::exchange(points_, {});
  KnownPairs<PointPair> known(old);
  for (std::int32_t p : lattice.dynamic_points) {
    const Vec3 local = to_frame(body, lattice.motion[p].position);
    const double reached = reach.least + lattice.motion[p].velocity.norm() * reach.time;
    const std::span<const PointPair> known_here = known.of(p);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (parts_[k].for_faces) continue;
      const PointPair* then = with_part(known_here, parts_[k].id);
      if (!is_held(then) && !may_touch(parts_[k], local, reached)) continue;
      points_.push_back(known_or_new(then, p, k, local));
      points_.back().law = law_at(lattice, p, parts_[k], dt);
    }
  }
}

void Obstacle::list_faces(const Lattice& lattice, const LatticeSurface& surface,
                          const ShadowBody& body, const ListingReach& reach, double dt) {
  const std::vector<FacePair> old = std::exchange(faces_, {});
  KnownPairs<FacePair> known(old);
  for (const SurfaceFace& face : surface.faces()) {
    const Vec3 centre = FacePlace{face.corners}.position(lattice);
    double radius = 0.0, fastest = 0.0;
    for (std::int32_t p : face.corners) {
      radius = std::max(radius, (lattice.motion[p].position - centre).norm());
      fastest = std::max(fastest, lattice.motion[p].velocity.norm());
    }
    const double reached = reach.least + fastest * reach.time + radius;
    const Vec3 local = to_frame(body, centre);
    const std::span<const FacePair> known_here = known.of(face.face);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (!fits_between_points(parts_[k])) continue;
      const FacePair* then = with_part(known_here, parts_[k].id);
      if (!is_held(then) && !may_touch(parts_[k], local, reached)) continue;
      FacePair pair = known_or_new(then, face.face, k, local);
      if (!then && parts_[k].for_faces && pair.track.inside) continue;  // not by a way in
      if (!then) pair.last = corners_in_frame(lattice, body, face.corners);
      pair.corners = face.corners;
      pair.law = law_at(lattice, face.corners[0], parts_[k], dt);
      pair.clear = 0.0;
      pair.sheet = face.sheet;
      faces_.push_back(pair);
    }
  }
}

void Obstacle::press(Lattice& lattice, const LatticeSurface& surface, ShadowBody& body,
                     const ObstacleShare& share, double dt) {
  if (body.movable()) pushed_ = 0;
  for (std::int32_t i : share.points) press_point(lattice, surface, body, points_[i], dt);
  for (std::int32_t i : share.faces) {
    if (surface.has(faces_[i].of)) press_face(lattice, body, faces_[i], dt);
  }
  if (body.movable()) sharers_ = std::max(1, pushed_);
}

void Obstacle::add_loads(double dt, std::vector<double>& loads) const {
  for (const PointPair& pair : points_) {
    if (pair.books.open) loads[pair.of] += pair.books.impulse / dt;
  }
  for (const FacePair& pair : faces_) {
    if (pair.books.open) loads[pair.corners[0]] += pair.books.impulse / dt;
  }
}

void Obstacle::mark_yielding(std::vector<std::uint8_t>& points) const {
  for (const PointPair& pair : points_) {
    if (pair.yields) points[pair.of] = 1;
  }
  for (const FacePair& pair : faces_) {
    if (!pair.yields) continue;
    for (std::int32_t p : pair.corners) points[p] = 1;
  }
}

void Obstacle::press_point(Lattice& lattice, const LatticeSurface& surface, ShadowBody& body,
                           PointPair& pair, double dt) {
  const ContactPart& part = parts_[pair.listed];
  const Vec3 now = to_frame(body, lattice.motion[pair.of].position) + pair.shift;
  if (stays_outside(part, now, pair.track)) return;
  const Penetration contact = follow(part, now, pair.track);
  if (contact.depth <= 0.0) return pair.let_go();
  come_down(pair.shift, contact.depth, dt);
  const bool new_here = !pair.holds && !surface.is_of_sheet(pair.of);
  if (new_here &&
      is_behind(contact.normal, direction_to_frame(body, surface.outwards_at(lattice, pair.of)))) {
    return;
  }
  push(lattice, body, pair, {pair.of}, contact, dt);
}

// Presses with the depth beyond that of its deepest corner, which presses as a point: the two join
// without a jump where the deepest place comes to a corner.
void Obstacle::press_face(Lattice& lattice, ShadowBody& body, FacePair& pair, double dt) {
  const Mat3 corners = corners_in_frame(lattice, body, pair.corners).colwise() + pair.shift;
  if ((corners - pair.last).colwise().squaredNorm().maxCoeff() < pair.clear * pair.clear) return;
  const ContactPart& part = parts_[pair.listed];
  const Mat3 before = std::exchange(pair.last, corners);
  const double size = (corners.colwise() - corners.col(0)).colwise().norm().maxCoeff();
  const FacePenetration deepest = deepest_place(part, corners, kDepthTolerance * size);
  pair.track.last = before * deepest.weights;  // the place may have moved on the face, this has not
  const Vec3 outwards = twice_area_vector({corners.col(0), corners.col(1), corners.col(2)});
  if (part.for_faces) hold_across(part, outwards, pair.track);
  Penetration contact = follow(part, corners * deepest.weights, pair.track);
  pair.clear = clearance(part, deepest, pair.track);
  if (contact.depth <= 0.0) return pair.let_go();
  come_down(pair.shift, contact.depth, dt);
  const bool new_here = !pair.holds && !pair.sheet;
  if (new_here && is_behind(contact.normal, outwards)) return;
  if (!pair.holds && is_within_body(part, contact.normal)) return;
  contact.depth -= std::max(0.0, deepest.corners);
  push(lattice, body, pair, {pair.corners, deepest.weights}, contact, dt);
  const bool presses = pair.books.open || pair.offset > 0.0;
  if (!presses) pair.clear = deepest.settled;
}

PenaltyContact Obstacle::law_at(const Lattice& lattice, std::int32_t point, const ContactPart& part,
                                double dt) const {
  const LatticeObject& object = lattice.objects[lattice.point_object[point]];
  PenaltyContact law = law_between(object, *object_);
  // With a modulus S times as soft all is sqrt(S) times as deep at the same speeds: contact too, or
  // softening would change the speed that breaks a thing.
  const double dents = std::sqrt(std::max(1.0, object.authored.object.softening));
  law.soft_depth = std::min(kSoftShare * dents * lattice.contact_radius[point],
                            std::min(kThinShare * dents, kThinMost) * thickness(part));
  law.deep_frequency = std::max(law.frequency, 2.0 * std::sqrt(kDeepStepShare) / dt);
  // What implicit springs do to a speed is not foreseen: it cannot be stopped.
  law.deepest = object.implicit ? kNoLimit : law.soft_depth;
  return law;
}

// Contacts share the body: each takes a mass m_i = 1 / (w_i + s b_i) for its spring k_i = omega^2
// m_i (w_i, b_i: what the place and the body move for an impulse, 1/kg), so that sum k_i b_i, the
// square of what n of them shake the body with, stays below kBodyStepShare of the step's limit.
// A body that is heavy beside what presses it bears all of them as it would one.
template <class Place>
double Obstacle::effective_mass(const Lattice& lattice, const ShadowBody& body, const Place& place,
                                const Vec3& normal) const {
  const double own = place.inverse_mass(lattice);
  if (!body.movable()) return 1.0 / own;
  const double behind = body.inverse_effective_mass(place.position(lattice), normal);
  const double needed = sharers_ * behind * (kDeepStepShare / kBodyStepShare) - own;
  return 1.0 / (own + std::max(behind, needed));
}

// 1/kg: what an impulse changes of the closing speed, with the same one at each of the contacts
// that share the body. Contacts that each stop their own share stop it together and no more.
template <class Place>
double Obstacle::gain_of(const Lattice& lattice, const ShadowBody& body, const Place& place,
                         const Vec3& normal) const {
  const double own = place.inverse_mass(lattice);
  if (!body.movable()) return own;
  return own + sharers_ * body.inverse_effective_mass(place.position(lattice), normal);
}

// What the last push did, if there was one.
template <class Place>
void Obstacle::settle(const Lattice& lattice, const ShadowBody& body, Pair<Place>& pair,
                      double dt) const {
  if (!pair.books.open) {
    pair.books.surprise = 0.0;  // that was longer ago
    return;
  }
  const Vec3 now = slip_at(lattice, body, pair.pressed);
  pair.books.settle(-now.dot(pair.normal));
  pair.friction.settle(now - now.dot(pair.normal) * pair.normal, dt);
}

// The normal force, N, at pair.pressed along pair.normal.
template <class Place>
double Obstacle::bear(const Lattice& lattice, const ShadowBody& body, Pair<Place>& pair,
                      const PenaltyContact& law, double depth, double dt) const {
  const Place& place = pair.pressed;
  const Vec3 after = place.velocity_after(lattice, dt);
  Approach at;
  at.depth = depth;
  at.closing = -slip_at(lattice, body, place).dot(pair.normal);
  at.foreseen = (body.velocity_at(place.position(lattice)) - after).dot(pair.normal);
  at.foreseeable = !is_implicit(lattice, place.lawgiver());
  at.easing = pair.offset > 0.0;
  at.forgiven = law.elastic_energy(pair.books.mass, std::max(0.0, depth));
  return limber::bear(pair.books, law, at, gain_of(lattice, body, place, pair.normal) * dt, dt);
}

template <class Place>
void Obstacle::push(Lattice& lattice, ShadowBody& body, Pair<Place>& pair, const Place& place,
                    const Penetration& contact, double dt) {
  const bool counted = pair.books.open;  // among the sharers
  settle(lattice, body, pair, dt);
  pair.yields = false;
  const double depth = eased(contact.depth, pair.offset, dt);
  if (depth <= 0.0 && pair.offset == 0.0) return;
  const Vec3 normal = at_rest_ ? contact.normal : Vec3(body.rotation * contact.normal);
  pair.books.share_mass(effective_mass(lattice, body, place, normal));
  if (std::isinf(pair.books.mass)) return;
  pair.pressed = place;
  pair.normal = normal;
  PenaltyContact law = pair.law;
  if (!counted) law.deepest = kNoLimit;
  const double press = bear(lattice, body, pair, law, depth, dt);
  if (body.movable()) ++pushed_;
  const double elastic = law.elastic_force(pair.books.mass, depth);
  const double may_come = std::min(depth / kYieldTime, kYieldSpeed);
  pair.yields = depth > kLeastYielding && press < kBearingShare * elastic &&
                -pair.books.closing_speed > kComingShare * may_come;
  if (press <= 0.0) return;
  const Vec3 slip = slip_at(lattice, body, place);
  const Vec3 force = press * normal + pair.friction.pull(law, press, pair.books.mass, normal,
                                                         slip - slip.dot(normal) * normal, dt);
  place.add_force(lattice, force);
  if (body.movable()) body.add_force(-force, place.position(lattice));
  pair.pushed += force.norm() * dt;
  pair.holds = true;
}

template <class Place>
void Obstacle::Pair<Place>::let_go() {
  offset = 0.0;
  shift.setZero();
  books = {};
  friction = {};
  holds = yields = false;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
