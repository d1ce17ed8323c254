#include "bullet_bridge/shapes/convex_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Up to this many planes are looked at one by one; a grid would save nothing.
constexpr std::size_t kFewPlanes = 12;
constexpr int kGridCells = 16;  // along each axis, a power of two

double above(const HullPlane& plane, const Vec3& point) {
  return plane.normal.dot(point) - plane.offset;
}

std::int32_t highest(std::span<const HullPlane> planes, std::span<const std::int32_t> among,
                     const Vec3& point) {
  std::int32_t best = among.front();
  double most = -std::numeric_limits<double>::infinity();
  for (std::int32_t i : among) {
    const double d = above(planes[i], point);
    if (d > most) {
      most = d;
      best = i;
    }
  }
  return best;
}

// Those that `best` does not beat all over the box.
std::vector<std::int32_t> not_beaten(std::span<const HullPlane> planes,
                                     std::span<const std::int32_t> among, std::int32_t best,
                                     const Vec3& centre, const Vec3& half) {
  // Rounding must not lose a plane: 1e-12 of the distances that were subtracted.
  const double rounding = 1e-12 * (centre.cwiseAbs() + half).sum();
  const double best_above = above(planes[best], centre);
  std::vector<std::int32_t> rest;
  for (std::int32_t i : among) {
    const double behind = best_above - above(planes[i], centre);
    const double catches_up = (planes[i].normal - planes[best].normal).cwiseAbs().dot(half);
    if (behind <= catches_up + rounding) rest.push_back(i);
  }
  return rest;
}

// Those that may be the nearest one somewhere in the box: the nearest one at its centre, then those
// at its corners, beat most.
std::vector<std::int32_t> possible_in_box(std::span<const HullPlane> planes,
                                          std::span<const std::int32_t> among, const Vec3& centre,
                                          const Vec3& half) {
  std::vector<std::int32_t> possible =
      not_beaten(planes, among, highest(planes, among, centre), centre, half);
  for (int corner = 0; corner < 8 && possible.size() > kFewPlanes / 2; ++corner) {
    const Vec3 at =
        centre + Vec3(corner & 1 ? half.x() : -half.x(), corner & 2 ? half.y() : -half.y(),
                      corner & 4 ? half.z() : -half.z());
    possible = not_beaten(planes, possible, highest(planes, possible, at), centre, half);
  }
  return possible;
}

Vec3 nearest_on_edge(const Vec3& a, const Vec3& b, const Vec3& point) {
  const Vec3 way = b - a;
  return a + std::clamp((point - a).dot(way) / way.squaredNorm(), 0.0, 1.0) * way;
}

}  // namespace

ConvexPlanes::ConvexPlanes(std::vector<Vec3> corners, const std::vector<HullFace>& faces,
                           double reach)
    : corners_(std::move(corners)), low_(corners_.front()), high_(corners_.front()) {
  for (const HullFace& face : faces) {
    planes_.push_back(face.plane);
    const auto begin = static_cast<std::int32_t>(loop_corners_.size());
    loop_corners_.insert(loop_corners_.end(), face.corners.begin(), face.corners.end());
    loop_.push_back({begin, static_cast<std::int32_t>(loop_corners_.size())});
    for (std::int32_t c : face.corners) {
      low_ = low_.cwiseMin(corners_[c]);
      high_ = high_.cwiseMax(corners_[c]);
    }
  }
  cells_ = planes_.size() <= kFewPlanes ? 1 : kGridCells;
  grid_low_ = low_.array() - reach;
  cell_size_ = (high_ - low_ + Vec3::Constant(2.0 * reach)) / cells_;
  cell_.resize(static_cast<std::size_t>(cells_) * cells_ * cells_);
  std::vector<std::int32_t> all(planes_.size());
  std::iota(all.begin(), all.end(), 0);
  fill({0, 0, 0}, cells_, all);
}

// Halves the box until it is a cell; most planes drop out while it is still large.
void ConvexPlanes::fill(std::array<int, 3> first, int width, std::span<const std::int32_t> planes) {
  const Vec3 half = 0.5 * width * cell_size_;
  const Vec3 corner(first[0], first[1], first[2]);
  const Vec3 centre = grid_low_ + corner.cwiseProduct(cell_size_) + half;
  const std::vector<std::int32_t> possible = possible_in_box(planes_, planes, centre, half);
  if (width == 1) {
    const auto begin = static_cast<std::int32_t>(cell_planes_.size());
    cell_planes_.insert(cell_planes_.end(), possible.begin(), possible.end());
    cell_[cell_at(first[0], first[1], first[2])] = {begin,
                                                    static_cast<std::int32_t>(cell_planes_.size())};
    return;
  }
  const int w = width / 2;
  for (int octant = 0; octant < 8; ++octant) {
    fill({first[0] + (octant & 1 ? w : 0), first[1] + (octant & 2 ? w : 0),
          first[2] + (octant & 4 ? w : 0)},
         w, possible);
  }
}

std::span<const std::int32_t> ConvexPlanes::planes_near(const Vec3& point) const {
  std::array<int, 3> c;
  for (int k = 0; k < 3; ++k) {
    const double at = (point[k] - grid_low_[k]) / cell_size_[k];
    if (!(at >= 0.0 && at < cells_)) return {};
    c[k] = static_cast<int>(at);
  }
  const Range r = cell_[cell_at(c[0], c[1], c[2])];
  return std::span(cell_planes_).subspan(r.begin, r.end - r.begin);
}

std::int32_t ConvexPlanes::nearest_plane(const Vec3& point) const {
  const std::span<const std::int32_t> near = planes_near(point);
  std::int32_t best = 0;
  if (!near.empty()) {
    best = highest(planes_, near, point);
  } else {
    for (std::size_t i = 1; i < planes_.size(); ++i) {
      if (above(planes_[i], point) > above(planes_[best], point)) best = static_cast<int>(i);
    }
  }
  return best;
}

bool ConvexPlanes::parted_from(const Vec3& a, const Vec3& b, double margin) const {
  const HullPlane& plane = planes_[nearest_plane(b)];
  return above(plane, a) > margin && above(plane, b) > margin;
}

Penetration ConvexPlanes::penetration(const Vec3& point, double margin) const {
  const std::int32_t best = nearest_plane(point);
  const double over = above(planes_[best], point);
  if (over <= 0.0) return {margin - over, planes_[best].normal};
  return outside(point, margin, best);
}

Penetration ConvexPlanes::outside(const Vec3& point, double margin, std::int32_t first) const {
  Vec3 nearest = nearest_on_face(first, point);
  double distance = (point - nearest).norm();
  if (distance <= above(planes_[first], point) * (1.0 + 1e-12)) {
    return {margin - distance, planes_[first].normal};
  }
  // The foot lies beside the face: the nearest corner or edge may be one of another face that sees
  // the point.
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const double over = above(planes_[i], point);
    if (over <= 0.0 || over >= distance || static_cast<std::int32_t>(i) == first) continue;
    const Vec3 foot = nearest_on_face(static_cast<std::int32_t>(i), point);
    const double d = (point - foot).norm();
    if (d >= distance) continue;
    distance = d;
    nearest = foot;
  }
  return {margin - distance, (point - nearest) / distance};
}

Vec3 ConvexPlanes::nearest_on_face(std::int32_t face, const Vec3& point) const {
  const HullPlane& plane = planes_[face];
  const Range loop = loop_[face];
  const Vec3 foot = point - above(plane, point) * plane.normal;
  Vec3 best = foot;
  double least = std::numeric_limits<double>::infinity();
  bool beside = false;
  for (std::int32_t i = loop.begin; i < loop.end; ++i) {
    const Vec3& a = corners_[loop_corners_[i]];
    const Vec3& b = corners_[loop_corners_[i + 1 < loop.end ? i + 1 : loop.begin]];
    if (plane.normal.dot((b - a).cross(foot - a)) >= 0.0) continue;
    beside = true;
    const Vec3 on_edge = nearest_on_edge(a, b, point);
    const double d = (point - on_edge).squaredNorm();
    if (d < least) {
      least = d;
      best = on_edge;
    }
  }
  return beside ? best : foot;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
