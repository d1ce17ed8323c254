#include "core/contact/cell_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/contact/bearing_contact.h"

namespace limber {
namespace {

// Shares of a corner's height over a face in the shape as added. What has come below the first may
// come no faster than the stop of bearing_force() allows, and not below the second. A brick can so
// be pressed to a tenth of its height (the vice of docs/bridge.md); a stop needs some substeps'
// way, and cells that buckle do so at a tenth of their height a substep.
constexpr double kRoom = 0.4;
constexpr double kLeastRoom = 0.1;

// Below this share a corner is looked at in every substep.
constexpr double kWatchShare = 0.7;

// No corner has lost that much height before some edge of its cell is longer or shorter by this
// share: the centre of a regular tetrahedron's face, the nearest flat shape, is 0.58 sides from its
// corners; a corner of a cube comes into the plane of its three neighbours at 0.82 of their
// distance.
constexpr double kStrain = 0.1;

// Of what surprises a contact in a substep, the next one counts this share, the rest later. Corners
// are pressed from many sides, each of which counts on what the others did last: with the whole of
// it they take turns, and a column that is crushed under a load trembles at a tenth of what the
// load makes it in a substep.
constexpr double kSurpriseShare = 0.5;

// Substeps between two looks at the springs while none is strained by that much, and while some
// are. In 8 substeps of the largest step a wave passes some three cells: what is hit at a fifth of
// its speed has lost half of a cell. A look costs as much as the springs of a substep in single
// precision.
constexpr int kCalmInterval = 8;
constexpr int kStrainedInterval = 4;

// A corner that is nearer to a face's plane than this share of what the farthest one of the cell is
// is part of that side of the cell: sides are split into triangles, and may be a little bent.
constexpr double kSameSide = 0.2;

// Twice the area of a face that has none, against its longest side squared: no normal.
constexpr double kFlat = 1e-12;

template <class PositionOf>
Triangle triangle_of(const Lattice& lattice, std::int32_t face, PositionOf position_of) {
  const auto& [a, b, c] = lattice.face_corners[face];
  return {position_of(a), position_of(b), position_of(c)};
}

// Unit, out of the cell; zero for a face without area.
Vec3 outwards(const Triangle& t) {
  const Vec3 area = twice_area_vector(t);
  const double size = std::max((t[1] - t[0]).squaredNorm(), (t[2] - t[0]).squaredNorm());
  const double length = area.norm();
  return length > kFlat * size ? Vec3(area / length) : Vec3(Vec3::Zero());
}

bool has_corner(const Lattice& lattice, std::int32_t face, std::int32_t point) {
  const auto& corners = lattice.face_corners[face];
  return std::find(corners.begin(), corners.end(), point) != corners.end();
}

std::vector<std::int32_t> corners_of(const Lattice& lattice, std::size_t cell) {
  std::vector<std::int32_t> points;
  for (std::int32_t f : lattice.topology.cell_faces[cell]) {
    points.insert(points.end(), lattice.face_corners[f].begin(), lattice.face_corners[f].end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

FaceMotion motion_of(const Lattice& lattice, std::int32_t point, std::int32_t face) {
  const auto& [a, b, c] = lattice.face_corners[face];
  return {lattice.motion[point].velocity,
          {lattice.motion[a].velocity, lattice.motion[b].velocity, lattice.motion[c].velocity}};
}

FaceMotion motion_after(const Lattice& lattice, std::int32_t point, std::int32_t face, double dt) {
  const auto& [a, b, c] = lattice.face_corners[face];
  return {velocity_after(lattice, point, dt),
          {velocity_after(lattice, a, dt), velocity_after(lattice, b, dt),
           velocity_after(lattice, c, dt)}};
}

FaceMobility mobility_of(const Lattice& lattice, std::int32_t point, std::int32_t face) {
  const auto& [a, b, c] = lattice.face_corners[face];
  return {lattice.inverse_mass[point],
          {lattice.inverse_mass[a], lattice.inverse_mass[b], lattice.inverse_mass[c]}};
}

// The point against the plane of the face; the foot may be beside the triangle. No depth against a
// face without area.
FaceContact contact_at(const Lattice& lattice, std::int32_t point, std::int32_t face, double room) {
  const Triangle t =
      triangle_of(lattice, face, [&](std::int32_t p) { return lattice.motion[p].position; });
  FaceContact contact;
  contact.normal = -outwards(t);
  if (contact.normal.isZero(0.0)) return contact;
  const Vec3& x = lattice.motion[point].position;
  const double height = (x - t[0]).dot(contact.normal);
  const Vec3 foot = x - height * contact.normal, area = twice_area_vector(t);
  contact.weights[0] = (t[1] - foot).cross(t[2] - foot).dot(area) / area.squaredNorm();
  contact.weights[1] = (t[2] - foot).cross(t[0] - foot).dot(area) / area.squaredNorm();
  contact.weights[2] = 1.0 - contact.weights[0] - contact.weights[1];
  contact.depth = room - height;
  return contact;
}

}  // namespace

void CellContacts::refresh(const Lattice& lattice, bool topology_changed) {
  if (topology_changed) until_look_ = 0;
  for (std::size_t c = points_.rows(); c < lattice.topology.cell_faces.rows(); ++c) {
    if (points_.start.empty()) points_.start.push_back(0);
    const std::vector<std::int32_t> corners = corners_of(lattice, c);
    points_.items.insert(points_.items.end(), corners.begin(), corners.end());
    points_.start.push_back(static_cast<std::int32_t>(points_.items.size()));
  }
  is_strained_.resize(points_.rows(), 0);
}

void CellContacts::take_over(CellContacts&& other) {
  held_.insert(held_.end(), other.held_.begin(), other.held_.end());
  std::stable_sort(held_.begin(), held_.end(),
                   [](const Held& l, const Held& r) { return l.cell < r.cell; });
}

void CellContacts::add_forces(Lattice& lattice, double dt) {
  if (until_look_-- <= 0) look(lattice);
  for (Held& held : held_) {
    if (lattice.breaking.cell_valid[held.cell]) push(lattice, held, dt);
  }
}

void CellContacts::look(const Lattice& lattice) {
  find_strained_cells(lattice);
  until_look_ = (strained_.empty() ? kCalmInterval : kStrainedInterval) - 1;
  const std::vector<Held> before = std::exchange(held_, {});
  const auto of_cell = [](const Held& held, std::int32_t cell) { return held.cell < cell; };
  for (std::int32_t c : strained_) {
    is_strained_[c] = 0;
    const auto first = std::lower_bound(before.begin(), before.end(), c, of_cell);
    const auto last = std::lower_bound(first, before.end(), c + 1, of_cell);
    hold_what_is_low(lattice, c, {first, last});
  }
}

void CellContacts::find_strained_cells(const Lattice& lattice) {
  constexpr double kShort = (1.0 - kStrain) * (1.0 - kStrain);
  constexpr double kLong = (1.0 + kStrain) * (1.0 + kStrain);
  strained_.clear();
  for (std::size_t i = 0; i < lattice.active.size(); ++i) {
    const Spring& s = lattice.active[i];
    const double square =
        (lattice.motion[s.b].position - lattice.motion[s.a].position).squaredNorm();
    const double rest = s.rest_length * s.rest_length;
    if (square > kShort * rest && square < kLong * rest) continue;
    for (std::int32_t c : lattice.topology.edge_cells[lattice.active_edge[i]]) {
      if (is_strained_[c] || !lattice.breaking.cell_valid[c]) continue;
      is_strained_[c] = 1;
      strained_.push_back(c);
    }
  }
  std::sort(strained_.begin(), strained_.end());
}

// Those that were held go on as they were.
void CellContacts::hold_what_is_low(const Lattice& lattice, std::int32_t cell,
                                    std::span<const Held> before) {
  for (std::int32_t f : lattice.topology.cell_faces[cell]) {
    const Triangle then =
        triangle_of(lattice, f, [&](std::int32_t p) { return lattice.authored_position[p]; });
    const Triangle now =
        triangle_of(lattice, f, [&](std::int32_t p) { return lattice.motion[p].position; });
    const Vec3 out_then = outwards(then), out_now = outwards(now);
    const auto rest_height = [&](std::int32_t p) {
      return (then[0] - lattice.authored_position[p]).dot(out_then);
    };
    double highest = 0.0;
    for (std::int32_t p : points_[cell]) highest = std::max(highest, rest_height(p));
    for (std::int32_t p : points_[cell]) {
      const double rest = rest_height(p);
      const double height = (now[0] - lattice.motion[p].position).dot(out_now);
      if (!(rest > kSameSide * highest) || height > kWatchShare * rest) continue;
      if (has_corner(lattice, f, p)) continue;
      const auto known = std::find_if(before.begin(), before.end(),
                                      [&](const Held& h) { return h.face == f && h.point == p; });
      if (known != before.end()) {
        held_.push_back(*known);
      } else {
        held_.push_back({cell, f, p, rest, std::max(0.0, kRoom * rest - height), {}, {}});
      }
    }
  }
}

void CellContacts::push(Lattice& lattice, Held& held, double dt) const {
  PassiveContact& books = held.books;
  const FaceMotion motion = motion_of(lattice, held.point, held.face);
  if (books.open) {
    const double before = books.surprise;
    books.settle(-separation_speed(held.contact, motion));
    books.surprise = before + kSurpriseShare * (books.surprise - before);
  }
  held.contact = contact_at(lattice, held.point, held.face, kRoom * held.rest_height);
  if (held.contact.depth <= 0.0) {
    const double debt = std::min(0.0, books.stored);
    books = {};
    books.stored = debt;
    held.offset = 0.0;
    return;
  }
  books.share_mass(contact_mass(held.contact, mobility_of(lattice, held.point, held.face)));
  if (std::isinf(books.mass)) return;
  PenaltyContact law;  // without a spring
  law.deepest = (kRoom - kLeastRoom) * held.rest_height;
  law.comes_back = held.offset > 0.0;
  Approach at;
  at.depth = eased(held.contact.depth, held.offset, dt);
  at.closing = -separation_speed(held.contact, motion);
  at.foreseen = -separation_speed(held.contact, motion_after(lattice, held.point, held.face, dt));
  at.foreseeable = !is_implicit(lattice, held.point);
  at.easing = held.offset > 0.0;
  const double press = bear(books, law, at, dt / books.mass, dt);
  if (press <= 0.0) return;
  const FaceForces forces = push_apart(held.contact, press);
  lattice.force[held.point] += forces.on_point;
  for (int i = 0; i < 3; ++i) {
    lattice.force[lattice.face_corners[held.face][i]] += forces.on_corners[i];
  }
}

}  // namespace limber
