#include "bullet_bridge/obstacle.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bullet_bridge/shapes/face_penetration.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// A penetration that was there when a contact was first seen is taken back at this speed, m/s: it
// bounds the kinetic energy per mass that easing out may cost to 1.25 mJ/kg, and clears a shell's
// wall of 5 mm in 0.1 s. Without it pieces that thaw again and again sink into the floor.
constexpr double kEaseSpeed = 0.05;

// A contact is soft, as the point-point penalty, to this share of the point's contact radius, and
// from there on as stiff as this share of the step's limit, 4 / dt^2, allows. The automatic step
// leaves 0.15 of it beyond springs and point-point contact; contact with faces of lattices takes
// 0.1, friction 0.05 of what is left when all meet at one point.
constexpr double kSoftShare = 0.2;
constexpr double kDeepStepShare = 0.03;

// The deepest place of a face is looked for to this share of the face's size: the force then is
// wrong by as much as a tenth of a millimetre of depth on a face of 10 cm.
constexpr double kDepthTolerance = 1e-3;

PenaltyContact law_between(const LatticeObject& object, const btCollisionObject& body) {
  const ObjectAttributes& attributes = object.authored.object;
  PenaltyContact law;
  law.frequency = object.contact_frequency;
  law.restitution = attributes.restitution * body.getRestitution();
  law.friction = attributes.friction * body.getFriction();
  return law;
}

// Lowers the depth by what was there at first, which is taken back slowly and never grows.
double eased(double depth, double& offset, double dt) {
  offset = std::min(std::max(0.0, offset - kEaseSpeed * dt), std::max(0.0, depth));
  return depth - offset;
}

bool may_touch(const ContactPart& part, const Vec3& local, double reach) {
  return within_reach(part, local, reach) && penetration(part, local).depth >= -reach;
}

// A plane is met by points first. Triangles have no depth that deepest_place() could look for: what
// stands out of a mesh and is thinner than the lattice's cells is met by points alone.
bool fits_between_points(const ContactPart& part) {
  return part.kind != ContactPart::Kind::kPlane && part.kind != ContactPart::Kind::kTriangles;
}

// Velocity of the lattice over the body at a place, m/s.
Vec3 slip_at(const Lattice& lattice, const ShadowBody& body, const LatticePlace& place) {
  return place.velocity(lattice) - body.velocity_at(place.position(lattice));
}

double depth_of_corners(const ContactPart& part, const Mat3& corners) {  // m, 0 for none inside
  double depth = 0.0;
  for (int i = 0; i < 3; ++i) depth = std::max(depth, penetration(part, corners.col(i)).depth);
  return depth;
}

}  // namespace

Vec3 LatticePlace::position(const Lattice& lattice) const {
  Vec3 sum = weights[0] * lattice.motion[points[0]].position;
  for (int i = 1; i < 3; ++i) sum += weights[i] * lattice.motion[points[i]].position;
  return sum;
}

Vec3 LatticePlace::velocity(const Lattice& lattice) const {
  Vec3 sum = weights[0] * lattice.motion[points[0]].velocity;
  for (int i = 1; i < 3; ++i) sum += weights[i] * lattice.motion[points[i]].velocity;
  return sum;
}

double LatticePlace::inverse_mass(const Lattice& lattice) const {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += weights[i] * weights[i] * lattice.inverse_mass[points[i]];
  return sum;
}

void LatticePlace::add_force(Lattice& lattice, const Vec3& force) const {
  for (int i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    lattice.force[points[i]] += weights[i] * force;
    lattice.touched[points[i]] = 1;
  }
}

Obstacle::Obstacle(const btCollisionObject& object, int shadow, const ShadowBody& body,
                   const Lattice& lattice, const Vec3& low, const Vec3& high, ShapeCache& cache)
    : object_(&object), shadow_(shadow), at_rest_(!body.movable() && !body.moves()) {
  const Mat3 to_body = body.rotation.transpose();
  const Vec3 middle = to_body * (0.5 * (low + high) - body.position);
  const Vec3 half = to_body.cwiseAbs() * (0.5 * (high - low));
  parts_ = contact_parts(*object.getCollisionShape(), middle - half, middle + half, cache);
  for (const LatticeObject& other : lattice.objects) laws_.push_back(law_between(other, object));
  if (!at_rest_) return;
  for (ContactPart& part : parts_) part = placed(part, body.position, body.rotation);
}

void Obstacle::remember(Obstacle&& last_tick) {
  sharers_ = last_tick.sharers_;
  if (at_rest_ != last_tick.at_rest_) return;  // its tracks are in another frame
  points_ = std::move(last_tick.points_);
  faces_ = std::move(last_tick.faces_);
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
                    const ListingReach& reach) {
  list_points(lattice, body, reach);
  list_faces(lattice, surface, body, reach);
}

// What is found inside without having come in starts without force (a proxy that thaws where its
// hull touches): the depth it has counts as surface until it has left.
template <class P>
P Obstacle::known_or_new(const std::vector<P>& old, std::int32_t of, std::size_t place,
                         const Vec3& local) const {
  const std::int32_t part = parts_[place].id;
  const auto known = std::lower_bound(
      old.begin(), old.end(), std::pair(of, part),
      [](const P& pair, const auto& key) { return std::pair(pair.of, pair.part) < key; });
  P pair;
  if (known != old.end() && known->of == of && known->part == part) {
    pair = *known;
  } else {
    pair.of = of;
    pair.part = part;
    pair.track = start_track(parts_[place], local);
    pair.offset = std::max(0.0, penetration(parts_[place], local).depth);
  }
  pair.place = place;
  return pair;
}

void Obstacle::list_points(const Lattice& lattice, const ShadowBody& body,
                           const ListingReach& reach) {
  const std::vector<Pair> old = std::exchange(points_, {});
  for (std::int32_t p : lattice.dynamic_points) {
    const Vec3 local = to_frame(body, lattice.motion[p].position);
    const double reached = reach.least + lattice.motion[p].velocity.norm() * reach.time;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (!may_touch(parts_[k], local, reached)) continue;
      points_.push_back(known_or_new(old, p, k, local));
    }
  }
}

void Obstacle::list_faces(const Lattice& lattice, const LatticeSurface& surface,
                          const ShadowBody& body, const ListingReach& reach) {
  const std::vector<FacePair> old = std::exchange(faces_, {});
  for (const SurfaceFace& face : surface.faces()) {
    const LatticePlace middle{face.corners, Vec3::Constant(1.0 / 3.0)};
    const Vec3 centre = middle.position(lattice);
    double radius = 0.0, fastest = 0.0;
    for (std::int32_t p : face.corners) {
      radius = std::max(radius, (lattice.motion[p].position - centre).norm());
      fastest = std::max(fastest, lattice.motion[p].velocity.norm());
    }
    const double reached = reach.least + fastest * reach.time + radius;
    const Vec3 local = to_frame(body, centre);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      if (!fits_between_points(parts_[k]) || !may_touch(parts_[k], local, reached)) continue;
      faces_.push_back(known_or_new(old, face.face, k, local));
      FacePair& pair = faces_.back();
      if (pair.corners != face.corners) pair.last = corners_in_frame(lattice, body, face.corners);
      pair.corners = face.corners;
      pair.sheet = face.sheet;
    }
  }
}

void Obstacle::press(Lattice& lattice, const LatticeSurface& surface, ShadowBody& body, double dt) {
  pushed_ = 0;
  for (Pair& pair : points_) press_point(lattice, surface, body, pair, dt);
  for (FacePair& pair : faces_) {
    if (surface.has(pair.of)) press_face(lattice, body, pair, dt);
  }
  sharers_ = std::max(1, pushed_);
}

// `outwards`: the lattice's own, of any length, zero where it has none; all in the obstacle's
// frame.
//
// A body presses a lattice from outside: the far skin of a thin wall is out of its reach, and what
// it would push further out is the near one's business. At rims the body touches across the
// surface's normal; from 30 degrees on it is behind it.
Penetration Obstacle::meet(Pair& pair, const Vec3& now, const Vec3& outwards,
                           bool two_sided) const {
  Penetration contact = follow(parts_[pair.place], now, pair.track);
  if (contact.depth <= 0.0) {
    pair.let_go();
  } else if (!two_sided && pair.books.stored == 0.0 &&
             contact.normal.dot(outwards) > 0.5 * outwards.norm()) {
    contact.depth = 0.0;
  }
  return contact;
}

void Obstacle::press_point(Lattice& lattice, const LatticeSurface& surface, ShadowBody& body,
                           Pair& pair, double dt) {
  const Vec3 now = to_frame(body, lattice.motion[pair.of].position);
  if (stays_outside(parts_[pair.place], now, pair.track)) return;
  const Vec3 outwards = direction_to_frame(body, surface.outwards_at(lattice, pair.of));
  const Penetration contact = meet(pair, now, outwards, surface.is_of_sheet(pair.of));
  if (contact.depth <= 0.0) return;
  push(lattice, body, pair, {{pair.of, pair.of, pair.of}, Vec3::UnitX()}, contact, dt);
}

// Presses with the depth beyond that of its deepest corner, which presses as a point: the two join
// without a jump where the deepest place comes to a corner.
void Obstacle::press_face(Lattice& lattice, ShadowBody& body, FacePair& pair, double dt) {
  const ContactPart& part = parts_[pair.place];
  const Mat3 corners = corners_in_frame(lattice, body, pair.corners);
  LatticePlace place{pair.corners, Vec3::Constant(1.0 / 3.0)};
  const Vec3 centre = corners * place.weights;
  const Mat3 before = std::exchange(pair.last, corners);
  const double radius = (corners.colwise() - centre).colwise().norm().maxCoeff();
  if (pair.track.inside || penetration(part, centre).depth + radius > 0.0) {
    place.weights = deepest_place(part, corners, kDepthTolerance * radius).weights;
  }
  const Vec3 outwards = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
  pair.track.last = before * place.weights;  // the place may have moved on the face, this has not
  Penetration contact = meet(pair, corners * place.weights, outwards, pair.sheet);
  if (contact.depth <= 0.0) return;
  contact.depth -= depth_of_corners(part, corners);
  push(lattice, body, pair, place, contact, dt);
}

PenaltyContact Obstacle::law_at(const Lattice& lattice, std::int32_t point, double dt) const {
  PenaltyContact law = laws_[lattice.point_object[point]];
  law.soft_depth = kSoftShare * lattice.contact_radius[point];
  law.deep_frequency = std::max(law.frequency, 2.0 * std::sqrt(kDeepStepShare) / dt);
  return law;
}

// Contacts share the body: all of them together do not shake it faster than one would.
double Obstacle::effective_mass(const Lattice& lattice, const ShadowBody& body,
                                const LatticePlace& place, const Vec3& normal) const {
  const double behind =
      body.movable() ? body.inverse_effective_mass(place.position(lattice), normal) : 0.0;
  return 1.0 / (place.inverse_mass(lattice) + sharers_ * behind);
}

void Obstacle::push(Lattice& lattice, ShadowBody& body, Pair& pair, const LatticePlace& place,
                    const Penetration& contact, double dt) {
  PassiveContact& books = pair.books;
  if (books.impulse > 0.0) {
    books.settle(-slip_at(lattice, body, pair.pressed).dot(pair.normal));
  }
  const double depth = eased(contact.depth, pair.offset, dt);
  if (depth <= 0.0 && pair.offset == 0.0) return;
  const Vec3 normal = at_rest_ ? contact.normal : Vec3(body.rotation * contact.normal);
  books.share_mass(effective_mass(lattice, body, place, normal));
  if (std::isinf(books.mass)) return;
  const Vec3 slip = slip_at(lattice, body, place);
  const double separation = slip.dot(normal);
  const PenaltyContact law = law_at(lattice, place.points[0], dt);
  double most = books.largest_impulse(-separation);
  if (pair.offset > 0.0) {
    books.forgive(law.elastic_energy(books.mass, std::max(0.0, depth)));
    most = std::max(most, books.mass * (kEaseSpeed - separation));
  }
  const double press = std::min(penalty_force(law, books.mass, depth, separation), most / dt);
  if (press <= 0.0) return;
  const Vec3 force = press * normal + pair.friction.pull(law, press, books.mass, normal,
                                                         slip - separation * normal, dt);
  place.add_force(lattice, force);
  if (body.movable()) body.add_force(-force, place.position(lattice));
  books.give(press * dt, -separation);
  pair.pressed = place;
  pair.normal = normal;
  ++pushed_;
}

void Obstacle::Pair::let_go() {
  offset = 0.0;
  books = {};
  friction = {};
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
