#include "bullet_bridge/contact_clusters.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// Of a cluster that is worth a thread: at 50 to 100 ns a pair some 20 microseconds.
constexpr std::size_t kLeastPairs = 300;

using Counts = std::vector<std::size_t>;  // of pairs, by piece

// Sets of pieces, each named by its lowest.
class PieceSets {
 public:
  explicit PieceSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t piece) {
    while (parent_[piece] != piece) piece = parent_[piece] = parent_[parent_[piece]];
    return piece;
  }
  void join_all(const Counts& met) {
    const auto is_met = [](std::size_t count) { return count > 0; };
    const auto first = std::find_if(met.begin(), met.end(), is_met);
    for (auto other = first; other != met.end(); ++other) {
      if (is_met(*other)) join(first - met.begin(), other - met.begin());
    }
  }

 private:
  void join(std::size_t a, std::size_t b) {
    const std::size_t i = of(a), j = of(b);
    parent_[std::max(i, j)] = std::min(i, j);
  }

  std::vector<std::size_t> parent_;
};

// Which cluster each piece is of; cluster 0 asks Bullet.
struct Grouping {
  std::vector<std::int32_t> cluster_of_piece;
  std::size_t clusters = 1;
};

Grouping group(PieceSets& sets, const Counts& pairs, const Counts& asking) {
  const std::size_t pieces = pairs.size();
  Counts pairs_of_set(pieces, 0), asking_of_set(pieces, 0);
  for (std::size_t p = 0; p < pieces; ++p) {
    pairs_of_set[sets.of(p)] += pairs[p];
    asking_of_set[sets.of(p)] += asking[p];
  }
  Grouping grouping{std::vector<std::int32_t>(pieces, 0), 1};
  std::size_t in_last = kLeastPairs;
  for (std::size_t p = 0; p < pieces; ++p) {
    const std::size_t set = sets.of(p);  // not above p
    if (set == p && pairs_of_set[p] > 0 && asking_of_set[p] == 0) {
      if (in_last >= kLeastPairs) ++grouping.clusters, in_last = 0;
      in_last += pairs_of_set[p];
      grouping.cluster_of_piece[p] = static_cast<std::int32_t>(grouping.clusters - 1);
    } else {
      grouping.cluster_of_piece[p] = grouping.cluster_of_piece[set];
    }
  }
  return grouping;
}

Grouping group_pieces(std::span<const Obstacle> obstacles, const ShadowSet& shadows,
                      const Components& pieces) {
  const auto count = static_cast<std::size_t>(pieces.count);
  PieceSets sets(count);
  Counts pairs(count, 0), asking(count, 0);
  for (const Obstacle& obstacle : obstacles) {
    Counts met(count, 0);
    obstacle.count_pairs(pieces.label, met);
    if (shadows[obstacle.shadow()].movable()) sets.join_all(met);
    for (std::size_t p = 0; p < count; ++p) {
      pairs[p] += met[p];
      if (obstacle.asks_bullet()) asking[p] += met[p];
    }
  }
  return group(sets, pairs, asking);
}

}  // namespace

std::vector<ContactCluster> contact_clusters(std::span<const Obstacle> obstacles,
                                             const ShadowSet& shadows, const Components& pieces) {
  const Grouping grouping = group_pieces(obstacles, shadows, pieces);
  std::vector<ContactCluster> clusters(grouping.clusters);
  clusters[0].asks_bullet = true;
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    std::vector<ObstacleShare> shares(grouping.clusters);
    obstacles[o].share_out(pieces.label, grouping.cluster_of_piece, shares);
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      if (shares[c].size() > 0) clusters[c].parts.push_back({o, std::move(shares[c])});
    }
  }
  return clusters;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
