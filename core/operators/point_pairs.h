#pragma once

#include <vector>

#include "core/model/geometric_model.h"

namespace limber {

using PointPositions = IdVector<PointId, Vec3>;

struct PointPair {
  PointId a, b;           // one of each set
  double distance = 0.0;  // m
  double rounding = 0.0;  // m, what rounding may have added or taken: distance_rounding()
};

// How far the distance of two points may be off by rounding alone, m: 16 units in the last place of
// their largest coordinate (4e-15 m at 1 m), because the coordinates themselves come out of a few
// operations. Points and distances authored on a grid of 1 um differ by 5e-13 m or more up to 1 m:
// what is equal on paper counts as equal, and nothing else does.
double distance_rounding(const Vec3& a, const Vec3& b);

// Every pair at most `distance_m` apart, distance - rounding <= distance_m, ordered by a, then b. A
// uniform grid keeps the cost near the number of points plus the number of pairs; positions have to
// be finite. A distance of 0 finds the points that coincide.
std::vector<PointPair> pairs_within(const PointPositions& a, const PointPositions& b,
                                    double distance_m);

// The pair least far apart; of equals the one with the smallest ids. Both sets have to have points.
PointPair nearest_pair(const PointPositions& a, const PointPositions& b);

// The pairs that join each point at most once: nearest first, of equals (up to rounding) those with
// the smallest ids, in this order. `pairs` may come in any order. Where a fine model meets a coarse
// one, all pairs would hang many points on one (paper, figure 4); these do not.
std::vector<PointPair> one_to_one(std::vector<PointPair> pairs);

}  // namespace limber
