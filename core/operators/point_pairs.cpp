#include "core/operators/point_pairs.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace limber {
namespace {

double rounding_at(double coordinate_m) {
  constexpr double kUnits = 16.0;  // in the last place
  return kUnits * std::numeric_limits<double>::epsilon() * coordinate_m;
}

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
};

Box bounds(const PointPositions& points) {
  Box box;
  for (const Vec3& x : points) {
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}

// Points sorted by the cube of side >= distance they lie in. The key has 21 bits for each of z, y
// and x, so that three cubes in a row along x are one run of the sorted list.
class PointGrid {
 public:
  PointGrid(const PointPositions& points, double distance_m) : box_(bounds(points)) {
    // Side no smaller than a millionth of the extent: coordinates stay below 2^20. A little more
    // than the distance: rounding must not put two points that far apart beyond the next cube.
    const double largest =
        std::max(box_.low.cwiseAbs().maxCoeff(), box_.high.cwiseAbs().maxCoeff());
    side_ = std::max(distance_m * (1.0 + 1e-6), (box_.high - box_.low).maxCoeff() / 1e6) +
            2.0 * rounding_at(largest);
    if (!(side_ > 0.0)) side_ = 1.0;  // one place, distance 0: any side will do
    for (PointId p : ids_of(points)) sorted_.push_back({key(coordinates(points[p])), p});
    std::sort(sorted_.begin(), sorted_.end());
  }

  // Every point in the 27 cubes around x, in increasing order.
  std::vector<PointId> near(const Vec3& x) const {
    std::vector<PointId> found;
    if (((x - box_.low).array() < -side_).any() || ((x - box_.high).array() > side_).any())
      return found;
    const std::array<std::int64_t, 3> c = coordinates(x);
    for (std::int64_t z = c[2] - 1; z <= c[2] + 1; ++z)
      for (std::int64_t y = c[1] - 1; y <= c[1] + 1; ++y) append_run({c[0], y, z}, found);
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  // From 2 up for the grid's own points, so that no neighbour of a point near it is negative.
  std::array<std::int64_t, 3> coordinates(const Vec3& x) const {
    std::array<std::int64_t, 3> c;
    for (int i = 0; i < 3; ++i)
      c[i] = 2 + static_cast<std::int64_t>(std::floor((x[i] - box_.low[i]) / side_));
    return c;
  }

  static std::int64_t key(const std::array<std::int64_t, 3>& c) {
    return (c[2] << 42) | (c[1] << 21) | c[0];
  }

  void append_run(const std::array<std::int64_t, 3>& centre, std::vector<PointId>& found) const {
    const std::int64_t first = key(centre) - 1;
    const auto from = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(first, PointId()));
    for (auto it = from; it != sorted_.end() && it->first <= first + 2; ++it)
      found.push_back(it->second);
  }

  Box box_;
  double side_ = 1.0;  // m
  std::vector<std::pair<std::int64_t, PointId>> sorted_;
};

// The axis along which the two sets lie furthest apart (or overlap least).
int separating_axis(const Box& a, const Box& b) {
  int axis = 0;
  const Vec3 gap = (a.low - b.high).cwiseMax(b.low - a.high);
  gap.maxCoeff(&axis);
  return axis;
}

std::vector<PointId> sorted_along(const PointPositions& points, int axis) {
  std::vector<PointId> ids;
  for (PointId p : ids_of(points)) ids.push_back(p);
  std::sort(ids.begin(), ids.end(), [&](PointId p, PointId q) {
    return std::pair(points[p][axis], p) < std::pair(points[q][axis], q);
  });
  return ids;
}

PointPair pair_of(const PointPositions& a, PointId p, const PointPositions& b, PointId q) {
  return {p, q, (b[q] - a[p]).norm(), distance_rounding(a[p], b[q])};
}

// By distance; what differs by rounding alone counts as the same and goes by id.
void sort_nearest_first(std::vector<PointPair>& pairs) {
  const auto nearer = [](const PointPair& p, const PointPair& q) {
    return std::tie(p.distance, p.a, p.b) < std::tie(q.distance, q.a, q.b);
  };
  const auto by_id = [](const PointPair& p, const PointPair& q) {
    return std::tie(p.a, p.b) < std::tie(q.a, q.b);
  };
  std::sort(pairs.begin(), pairs.end(), nearer);
  for (auto first = pairs.begin(); first != pairs.end();) {
    const double most = first->distance + 2.0 * first->rounding;  // either may be off
    const auto last = std::find_if(first, pairs.end(),
                                   [&](const PointPair& pair) { return pair.distance > most; });
    std::sort(first, last, by_id);
    first = last;
  }
}

void keep_nearer(PointPair& best, const PointPair& candidate) {
  if (std::tie(candidate.distance, candidate.a, candidate.b) <
      std::tie(best.distance, best.a, best.b))
    best = candidate;
}

}  // namespace

double distance_rounding(const Vec3& a, const Vec3& b) {
  return rounding_at(std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()));
}

std::vector<PointPair> pairs_within(const PointPositions& a, const PointPositions& b,
                                    double distance_m) {
  std::vector<PointPair> pairs;
  if (b.empty()) return pairs;
  const PointGrid grid(b, distance_m);
  for (PointId p : ids_of(a))
    for (PointId q : grid.near(a[p])) {
      const PointPair pair = pair_of(a, p, b, q);
      if (pair.distance - pair.rounding <= distance_m) pairs.push_back(pair);
    }
  return pairs;
}

std::vector<PointPair> one_to_one(std::vector<PointPair> pairs) {
  sort_nearest_first(pairs);
  std::set<PointId> taken_a, taken_b;
  std::vector<PointPair> chosen;
  for (const PointPair& pair : pairs) {
    if (taken_a.contains(pair.a) || taken_b.contains(pair.b)) continue;
    taken_a.insert(pair.a);
    taken_b.insert(pair.b);
    chosen.push_back(pair);
  }
  return chosen;
}

// Sweeps along one axis and gives up on a point once that axis alone is further than the best pair.
PointPair nearest_pair(const PointPositions& a, const PointPositions& b) {
  assert(!a.empty() && !b.empty());
  const int axis = separating_axis(bounds(a), bounds(b));
  const std::vector<PointId> sorted = sorted_along(b, axis);
  PointPair best;
  best.distance = std::numeric_limits<double>::infinity();
  for (PointId p : ids_of(a)) {
    const auto too_far = [&](PointId q) {
      return std::abs(b[q][axis] - a[p][axis]) > best.distance;
    };
    const auto middle = std::partition_point(sorted.begin(), sorted.end(),
                                             [&](PointId q) { return b[q][axis] < a[p][axis]; });
    for (auto q = middle; q != sorted.end() && !too_far(*q); ++q)
      keep_nearer(best, pair_of(a, p, b, *q));
    for (auto q = middle; q != sorted.begin() && !too_far(*(q - 1)); --q)
      keep_nearer(best, pair_of(a, p, b, *(q - 1)));
  }
  return best;
}

}  // namespace limber
