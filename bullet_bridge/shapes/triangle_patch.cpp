#include "bullet_bridge/shapes/triangle_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

constexpr double kFacing = 0.5;      // cosine of 60 degrees
constexpr double kSame = 1e-12;      // relative: two distances to one and the same point
constexpr double kSamePlace = 1e-9;  // of a way: edges that triangles share
constexpr double kGap = 1e-5;        // m between triangles that are meant to touch
constexpr int kMostCells = 64;       // of the grid along an axis
constexpr std::size_t kWalk = 48;    // triangles looked at around a point: a fan of 40 and some

double extent(const PatchTriangle& t) {
  const Vec3 low = t.corners[0].cwiseMin(t.corners[1]).cwiseMin(t.corners[2]);
  const Vec3 high = t.corners[0].cwiseMax(t.corners[1]).cwiseMax(t.corners[2]);
  return (high - low).maxCoeff();
}

// The nearest triangle of those looked at.
struct NearestTriangle {
  const Vec3& point;
  std::int32_t index = -1;  // -1: none yet
  NearestPoint at{Vec3::Zero(), std::numeric_limits<double>::infinity()};

  void look_at(const PatchTriangle& triangle, std::int32_t i) {
    const double height = triangle.height_of(point);
    if (height * height >= at.squared_distance) return;
    const NearestPoint here = nearest_on_triangle(point, triangle.corners);
    if (here.squared_distance < at.squared_distance) at = here, index = i;
  }
};

}  // namespace

TrianglePatch::TrianglePatch(std::vector<Raw> raw, double margin) {
  for (const Raw& r : raw) {
    const Vec3 area = twice_area_vector(r.corners);
    const double norm = area.norm();
    if (!(norm > 0.0)) continue;
    triangles_.push_back({.key = r.key, .corners = r.corners, .normal = area / norm, .next = {}});
  }
  std::stable_sort(triangles_.begin(), triangles_.end(),
                   [](const PatchTriangle& a, const PatchTriangle& b) { return a.key < b.key; });
  find_neighbours();
  make_grid(margin);
}

std::int32_t TrianglePatch::index_of(std::int64_t key) const {
  const auto found =
      std::lower_bound(triangles_.begin(), triangles_.end(), key,
                       [](const PatchTriangle& t, std::int64_t k) { return t.key < k; });
  if (found == triangles_.end() || found->key != key) return -1;
  return static_cast<std::int32_t>(found - triangles_.begin());
}

// Cells about as large as the triangles.
void TrianglePatch::make_grid(double margin) {
  cell_.assign(1, {0, 0});
  if (triangles_.empty()) return;
  low_ = high_ = triangles_[0].corners[0];
  double mean = 0.0;
  for (const PatchTriangle& t : triangles_) {
    for (const Vec3& c : t.corners) {
      low_ = low_.cwiseMin(c);
      high_ = high_.cwiseMax(c);
    }
    mean += extent(t) / static_cast<double>(triangles_.size());
  }
  low_.array() -= margin;
  high_.array() += margin;
  for (int k = 0; k < 3; ++k) {
    const double length = high_[k] - low_[k];
    cells_[k] = std::clamp(static_cast<int>(std::ceil(length / mean)), 1, kMostCells);
    cell_size_[k] = std::max(length / cells_[k], 1e-9 * mean);
  }
  cells_per_m_ = cell_size_.cwiseInverse();
  cell_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2], {0, 0});
  for (const PatchTriangle& t : triangles_) {
    for_each_cell_of(t, margin, [&](std::size_t cell) { ++cell_[cell].end; });
  }
  std::int32_t sum = 0;
  for (Range& r : cell_) {
    const std::int32_t count = r.end;
    r = {sum, sum};
    sum += count;
  }
  cell_triangles_.resize(sum);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for_each_cell_of(triangles_[i], margin, [&](std::size_t cell) {
      cell_triangles_[cell_[cell].end++] = static_cast<std::int32_t>(i);
    });
  }
}

TrianglePatch::Cell TrianglePatch::cell_of(const Vec3& point) const {
  Cell cell;
  for (int k = 0; k < 3; ++k) {
    const double at = (point[k] - low_[k]) * cells_per_m_[k];
    // Compared before it is cast: what is far off has no int.
    cell[k] = at <= 0.0 ? 0 : at >= cells_[k] ? cells_[k] - 1 : static_cast<int>(at);
  }
  return cell;
}

// By the triangle's plane; its bounds are known to overlap.
bool TrianglePatch::touches_cell(const PatchTriangle& triangle, const Cell& cell,
                                 double margin) const {
  const Vec3 half = 0.5 * cell_size_;
  const Vec3 steps(cell[0], cell[1], cell[2]);
  const Vec3 centre = low_ + steps.cwiseProduct(cell_size_) + half;
  const double rounding = 1e-9 * cell_size_.sum();
  return std::abs(triangle.height_of(centre)) <=
         triangle.normal.cwiseAbs().dot(half) + margin + rounding;
}

template <class Visit>
void TrianglePatch::for_each_cell_of(const PatchTriangle& t, double margin, Visit visit) const {
  const Vec3 reach = Vec3::Constant(margin) + 1e-9 * cell_size_;
  const Cell first = cell_of(t.corners[0].cwiseMin(t.corners[1]).cwiseMin(t.corners[2]) - reach);
  const Cell last = cell_of(t.corners[0].cwiseMax(t.corners[1]).cwiseMax(t.corners[2]) + reach);
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        if (touches_cell(t, {x, y, z}, margin)) visit(cell_index(x, y, z));
      }
    }
  }
}

// Each triangle of the cells in the box, some of them more than once.
template <class Visit>
void TrianglePatch::for_each_near(const Vec3& low, const Vec3& high, Visit visit) const {
  const Cell first = cell_of(low), last = cell_of(high);
  std::size_t count = 1;
  for (int k = 0; k < 3; ++k) count *= static_cast<std::size_t>(last[k] - first[k] + 1);
  if (count > triangles_.size()) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) visit(static_cast<std::int32_t>(i));
    return;
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const Range r = cell_[cell_index(x, y, z)];
        for (std::int32_t i = r.begin; i < r.end; ++i) visit(cell_triangles_[i]);
      }
    }
  }
}

TrianglePatch::Passing TrianglePatch::first_passed(const Vec3& a, const Vec3& b) const {
  Passing first;
  double last = -1.0;
  for_each_near(a.cwiseMin(b), a.cwiseMax(b), [&](std::int32_t i) {
    const PatchTriangle& t = triangles_[i];
    const double at_a = t.height_of(a), at_b = t.height_of(b);
    const bool front = at_a >= 0.0;
    if (front == (at_b >= 0.0) || !line_passes(t.corners, a, b)) return;
    const double share = at_a / (at_a - at_b);
    last = std::max(last, share);
    if (share < first.share) first = {{i, front}, share, false};
  });
  first.again = last > first.share + kSamePlace;
  return first;
}

bool TrianglePatch::parted(const Vec3& a, const Vec3& b) const {
  bool found = false;
  for_each_near(a.cwiseMin(b), a.cwiseMax(b), [&](std::int32_t i) {
    const PatchTriangle& t = triangles_[i];
    const double at_a = t.height_of(a), at_b = t.height_of(b);
    if (found || (at_a >= 0.0) == (at_b >= 0.0)) return;
    const double share = at_a / (at_a - at_b);
    if (share <= kSamePlace || share >= 1.0 - kSamePlace) return;
    found = line_passes(t.corners, a, b);
  });
  return found;
}

TrianglePatch::Nearest TrianglePatch::seen_from(TriangleSide side, const Vec3& point,
                                                const NearestPoint& at) const {
  const PatchTriangle& t = triangles_[side.triangle];
  return {.side = side,
          .foot = point_at(t.corners, at.weights),
          .distance = std::sqrt(at.squared_distance),
          .behind = (t.height_of(point) >= 0.0) != side.front,
          .on_border = false};
}

TrianglePatch::Nearest TrianglePatch::seen_from_its_side(const Vec3& point, std::int32_t triangle,
                                                         const NearestPoint& at) const {
  if (triangle < 0) return {};
  return seen_from({triangle, triangles_[triangle].height_of(point) >= 0.0}, point, at);
}

TrianglePatch::Nearest TrianglePatch::nearest_near(const Vec3& point) const {
  NearestTriangle nearest{point};
  for_each_near(point, point, [&](std::int32_t i) { nearest.look_at(triangles_[i], i); });
  return seen_from_its_side(point, nearest.index, nearest.at);
}

TrianglePatch::Nearest TrianglePatch::nearest_of_all(const Vec3& point) const {
  NearestTriangle nearest{point};
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    nearest.look_at(triangles_[i], static_cast<std::int32_t>(i));
  }
  return seen_from_its_side(point, nearest.index, nearest.at);
}

Penetration TrianglePatch::penetration(const Vec3& point, double margin) const {
  const Nearest nearest = nearest_of_all(point);
  if (nearest.side.triangle < 0) return {-std::numeric_limits<double>::infinity(), Vec3::UnitY()};
  const PatchTriangle& triangle = triangles_[nearest.side.triangle];
  const Vec3 away = point - nearest.foot;
  return {margin - nearest.distance,
          nearest.distance > 0.0 ? Vec3(away / nearest.distance) : triangle.normal};
}

TrianglePatch::Nearest TrianglePatch::nearest_around(TriangleSide from, const Vec3& point,
                                                     const Vec3& normal) const {
  struct Step {  // without initialisers: most of them are never used
    std::int32_t triangle;
    bool front;
    NearestPoint at;
    double squared() const { return at.squared_distance; }  // m^2
  };
  std::array<Step, kWalk> steps;
  std::size_t count = 1, best = 0;
  const auto step_to = [&](TriangleSide side) -> Step {
    return {side.triangle, side.front,
            nearest_on_triangle(point, triangles_[side.triangle].corners)};
  };
  const auto steepness = [&](const Step& s) {
    return std::abs(triangles_[s.triangle].height_of(point));
  };
  const auto farther = [&](const Step& s) {
    return s.squared() > steps[best].squared() * (1.0 + kSame);
  };
  steps[0] = step_to(from);
  for (std::size_t i = 0; i < count; ++i) {
    const Step& here = steps[i];
    if (farther(here)) continue;
    for (int k = 0; k < 3 && count < kWalk; ++k) {
      const TriangleSide next = triangles_[here.triangle].next[here.front][k];
      if (next.triangle < 0) continue;
      const bool agrees = facing(next).dot(normal) > kFacing;
      if (!agrees && !here.at.on_side(k)) continue;
      const bool known = std::any_of(steps.begin(), steps.begin() + count,
                                     [&](const Step& s) { return s.triangle == next.triangle; });
      if (known) continue;
      const Step there = step_to(next);
      if (farther(there)) continue;
      // Where the foot is on an edge of both, the one whose plane is farther tells behind from
      // before: the other plane may cut through the space on the wrong side of it.
      const bool nearer = there.squared() < steps[best].squared() * (1.0 - kSame);
      steps[count] = there;
      if (nearer || steepness(there) > steepness(steps[best])) best = count;
      ++count;
    }
  }
  const Step& last = steps[best];
  Nearest nearest = seen_from({last.triangle, last.front}, point, last.at);
  // A corner on the border belongs to triangles without an edge there, too.
  for (std::size_t i = 0; i < count; ++i) {
    if (farther(steps[i])) continue;
    for (int k = 0; k < 3; ++k) {
      const bool border = triangles_[steps[i].triangle].next[steps[i].front][k].triangle < 0;
      if (border && steps[i].at.on_side(k)) nearest.on_border = true;
    }
  }
  return nearest;
}

TriangleSide TrianglePatch::taking_over(const Nearest& last, const Vec3& point,
                                        const Vec3& normal) const {
  const double depth = std::abs(triangles_[last.side.triangle].height_of(point));
  TriangleSide best;
  // Beyond a fold of up to 45 degrees the depth differs by as much as the way beyond it.
  double least = 0.5 * depth + last.distance + kGap;
  const Vec3 reach = Vec3::Constant(last.distance + kGap);
  for_each_near(point - reach, point + reach, [&](std::int32_t i) {
    const PatchTriangle& t = triangles_[i];
    const double facing_it = t.normal.dot(normal);
    if (std::abs(facing_it) <= kFacing) return;
    const bool front = facing_it > 0.0;
    const double behind = front ? -t.height_of(point) : t.height_of(point);
    const double off = std::abs(behind - depth);
    if (behind <= 0.0 || off > least || (off == least && best.triangle >= 0)) return;
    // The point is over the triangle, or over a gap beside it.
    const double distance = std::sqrt(nearest_on_triangle(point, t.corners).squared_distance);
    if (distance > 1.05 * behind + kGap) return;
    least = off;
    best = {i, front};
  });
  return best;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
