#include "core/contact/outer_surface.h"

#include <algorithm>

#include "core/contact/piece_boxes.h"

namespace limber {
namespace {

// A contact share of 0 is an object without contact.
bool is_present(const Lattice& lattice, std::int32_t point) {
  return lattice.role[point] != PointRole::kIdle &&
         lattice.objects[lattice.point_object[point]].authored.object.contact_share > 0.0;
}

double longest_side(const Triangle& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

bool has_corner(const std::array<std::int32_t, 3>& corners, std::int32_t point) {
  return corners[0] == point || corners[1] == point || corners[2] == point;
}

}  // namespace

void OuterSurface::rebuild(const Lattice& lattice, const Components& pieces) {
  if (corners_.size() != lattice.face_corners.size()) {  // objects were added
    corners_ = lattice.face_corners;
    is_sheet_ = lattice.face_two_sided;
  }
  pieces_ = with_carriers(lattice, pieces);
  list_faces(lattice);
  list_points(lattice);
  link_points();
}

void OuterSurface::list_faces(const Lattice& lattice) {
  faces_.clear();
  double sum = 0.0;
  for (std::size_t f = 0; f < corners_.size(); ++f) {
    if (!lattice.breaking.face_external[f]) continue;
    const auto& [a, b, c] = corners_[f];
    if (!is_present(lattice, a) || !is_present(lattice, b) || !is_present(lattice, c)) continue;
    faces_.push_back(static_cast<std::int32_t>(f));
    const double size = longest_side(authored_triangle(lattice, faces_.back()));
    sum += size;
    least_face_size_ = faces_.size() == 1 ? size : std::min(least_face_size_, size);
  }
  mean_face_size_ = faces_.empty() ? 0.0 : sum / static_cast<double>(faces_.size());
}

// All but those that have cells around them on every side.
void OuterSurface::list_points(const Lattice& lattice) {
  constexpr std::uint8_t kInside = 1, kOutside = 2;
  std::vector<std::uint8_t> place(lattice.motion.size(), 0);
  for (std::size_t f = 0; f < corners_.size(); ++f) {
    const std::int32_t cell = lattice.topology.face_cell[f];
    const bool shows = lattice.breaking.face_external[f] != 0;
    if (!shows && (cell < 0 || !lattice.breaking.cell_valid[cell])) continue;
    for (std::int32_t p : corners_[f]) place[p] |= shows ? kOutside : kInside;
  }
  points_.clear();
  for (std::size_t p = 0; p < place.size(); ++p) {
    const auto point = static_cast<std::int32_t>(p);
    if (place[p] != kInside && is_present(lattice, point)) points_.push_back(point);
  }
}

void OuterSurface::link_points() {
  faces_at_.start.assign(pieces_.label.size() + 1, 0);
  for (std::int32_t f : faces_) {
    for (std::int32_t p : corners_[f]) ++faces_at_.start[p + 1];
  }
  for (std::size_t p = 0; p < pieces_.label.size(); ++p)
    faces_at_.start[p + 1] += faces_at_.start[p];
  faces_at_.items.resize(faces_at_.start.back());
  std::vector<std::int32_t> next(faces_at_.start.begin(), faces_at_.start.end() - 1);
  for (std::int32_t f : faces_) {
    for (std::int32_t p : corners_[f]) faces_at_.items[next[p]++] = f;
  }
}

Triangle OuterSurface::triangle(const Lattice& lattice, std::int32_t face) const {
  const auto& [a, b, c] = corners_[face];
  return {lattice.motion[a].position, lattice.motion[b].position, lattice.motion[c].position};
}

Triangle OuterSurface::authored_triangle(const Lattice& lattice, std::int32_t face) const {
  const auto& [a, b, c] = corners_[face];
  return {lattice.authored_position[a], lattice.authored_position[b], lattice.authored_position[c]};
}

bool OuterSurface::adjacent(std::int32_t face, std::int32_t other) const {
  const auto& corners = corners_[face];
  return std::any_of(corners.begin(), corners.end(),
                     [&](std::int32_t p) { return has_corner(corners_[other], p); });
}

bool OuterSurface::continues_beyond(std::int32_t face, int corner) const {
  const std::int32_t from = corners_[face][(corner + 1) % 3], to = corners_[face][(corner + 2) % 3];
  const auto there = faces_at(from);
  return std::any_of(there.begin(), there.end(), [&](std::int32_t other) {
    return other != face && has_corner(corners_[other], to);
  });
}

bool OuterSurface::same_orientation(std::int32_t face, std::int32_t other) const {
  const auto &c = corners_[face], &o = corners_[other];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (c[i] == o[j] && c[(i + 1) % 3] == o[(j + 1) % 3]) return false;
    }
  }
  return true;
}

}  // namespace limber
