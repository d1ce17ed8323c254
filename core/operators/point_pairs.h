#pragma once

#include <vector>

#include "core/model/geometric_model.h"

namespace limber {

using PointPositions = IdVector<PointId, Vec3>;

struct PointPair {
  PointId a, b;           // one of each set
  double distance = 0.0;  // m
};

// Every pair at most `distance_m` apart, ordered by a, then b. A uniform grid keeps the cost near
// the number of points plus the number of pairs; positions have to be finite.
std::vector<PointPair> pairs_within(const PointPositions& a, const PointPositions& b,
                                    double distance_m);

// The pair least far apart; of equals the one with the smallest ids. Both sets have to have points.
PointPair nearest_pair(const PointPositions& a, const PointPositions& b);

}  // namespace limber
