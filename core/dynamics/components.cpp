#include "core/dynamics/components.h"

#include <algorithm>
#include <numeric>

namespace limber {
namespace {

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::int32_t root(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  // The smaller root wins, so that labels do not depend on the order of the edges.
  void join(std::int32_t i, std::int32_t j) {
    const std::int32_t ri = root(i), rj = root(j);
    parent_[std::max(ri, rj)] = std::min(ri, rj);
  }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace

Components components(const Lattice& lattice) {
  UnionFind sets(lattice.motion.size());
  for (std::size_t i = 0; i < lattice.active.size(); ++i) {
    if (lattice.breaking.edge_broken[lattice.active_edge[i]]) continue;
    sets.join(lattice.active[i].a, lattice.active[i].b);
  }
  Components result;
  result.label.assign(lattice.motion.size(), -1);
  for (std::int32_t p : lattice.dynamic_points) {
    const std::int32_t root = sets.root(p);
    if (root == p) result.label[p] = result.count++;
    result.label[p] = result.label[root];
  }
  return result;
}

std::vector<std::vector<std::int32_t>> points_of(const Components& components) {
  std::vector<std::vector<std::int32_t>> points(components.count);
  for (std::size_t p = 0; p < components.label.size(); ++p) {
    const std::int32_t label = components.label[p];
    if (label >= 0) points[label].push_back(static_cast<std::int32_t>(p));
  }
  return points;
}

}  // namespace limber
