#include "bullet_bridge/shapes/face_penetration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Boxes and hulls need up to 6, round parts one for every digit of the depth.
constexpr std::size_t kMostCuts = 16;

// A bound on the depth over the face: depth <= values . weights.
struct Cut {
  Vec3 values;  // m, at the corners
};

struct Maximum {
  Vec3 weights = Vec3::UnitX();
  double bound = -1e300;  // m
};

// The least of all bounds, as a function of the weights, and where that is highest.
class DepthBound {
 public:
  // Where the new cut takes the present maximum away, it is active at the next one, together with
  // two of the other cuts and of the sides of the face.
  void add(const Cut& cut) {
    cuts_[count_++] = cut;
    Maximum best;
    const std::size_t others = count_ + 2;  // 3 sides, then all cuts but the new one
    for (std::size_t i = 0; i < others; ++i) {
      for (std::size_t j = i + 1; j < others; ++j) improve(best, cut, i, j);
    }
    if (count_ > 1) consider(best, maximum_.weights);
    maximum_ = best;
  }
  const Maximum& maximum() const { return maximum_; }
  bool full() const { return count_ == kMostCuts; }

 private:
  // Where the new cut equals another one, or a weight is zero: weights on which this row vanishes.
  Vec3 row(const Cut& cut, std::size_t k) const {
    if (k < 3) return Vec3::Unit(static_cast<Eigen::Index>(k));
    return cut.values - cuts_[k - 3].values;
  }

  void improve(Maximum& best, const Cut& cut, std::size_t i, std::size_t j) const {
    const Vec3 direction = row(cut, i).cross(row(cut, j));
    const double sum = direction.sum();
    if (sum == 0.0) return;
    const Vec3 weights = direction / sum;
    if (weights.minCoeff() >= -1e-12) consider(best, weights);
  }

  void consider(Maximum& best, const Vec3& weights) const {
    double bound = 1e300;
    for (std::size_t k = 0; k < count_; ++k) {
      bound = std::min(bound, cuts_[k].values.dot(weights));
    }
    if (bound > best.bound) best = {weights, bound};
  }

  std::array<Cut, kMostCuts> cuts_;
  std::size_t count_ = 0;
  Maximum maximum_;
};

// What a look at one place tells: depth <= (depth + normal . place) - normal . anywhere.
Cut cut_at(const Penetration& here, const Vec3& place, const Mat3& corners) {
  const double level = here.depth + here.normal.dot(place);
  return {Vec3::Constant(level) - corners.transpose() * here.normal};
}

// m: however it moves by less, the point has the same side of the box nearest to it, or is in front
// of it. The difference of its distances to two sides changes by at most twice its way.
double box_side_margin(const Vec3& half_extents, const Vec3& point) {
  const Vec3 beyond = point.cwiseAbs() - half_extents;  // m, of the sides; below 0: behind them
  int nearest = 0;
  const double first = beyond.maxCoeff(&nearest);
  const double second = std::max(beyond[(nearest + 1) % 3], beyond[(nearest + 2) % 3]);
  return std::min({std::abs(point[nearest]), -second, 0.5 * (first - second)});
}

// Of a face that has one and the same side next to its corners. 0: not known.
double settled_way(const ContactPart& part, const Mat3& corners) {
  if (part.kind != ContactPart::Kind::kBox) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3 own = part.to_part_frame(corners.col(i));
    least = std::min(least, box_side_margin(part.half_extents, own));
  }
  return std::max(0.0, least);
}

}  // namespace

FacePenetration deepest_place(const ContactPart& part, const Mat3& corners, double tolerance_m) {
  std::array<Penetration, 3> at;
  FacePenetration deepest{.weights = Vec3::UnitX(), .depth = -1e300};
  for (int i = 0; i < 3; ++i) {
    at[i] = penetration(part, corners.col(i));
    if (at[i].depth > deepest.depth) deepest = {.weights = Vec3::Unit(i), .depth = at[i].depth};
  }
  deepest.bound = deepest.corners = deepest.depth;
  // In front of one side the depth is linear: the most frequent case by far.
  if (at[0].normal == at[1].normal && at[0].normal == at[2].normal) {
    deepest.settled = settled_way(part, corners);
    return deepest;
  }
  DepthBound bound;
  for (int i = 0; i < 3; ++i) bound.add(cut_at(at[i], corners.col(i), corners));
  while (!bound.full() && bound.maximum().bound > deepest.depth + tolerance_m) {
    if (bound.maximum().bound <= 0.0) {
      const auto& [weights, least] = bound.maximum();
      return {weights, least, least, deepest.corners, 0.0};
    }
    const Vec3 weights = bound.maximum().weights.cwiseMax(0.0);
    const Vec3 place = corners * weights;
    const Penetration here = penetration(part, place);
    if (here.depth > deepest.depth) deepest = {weights, here.depth, 0.0, deepest.corners, 0.0};
    bound.add(cut_at(here, place, corners));
  }
  deepest.bound = bound.maximum().bound;
  return deepest;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
