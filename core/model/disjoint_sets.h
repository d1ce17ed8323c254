#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace limber {

// Union-find over 0 .. n - 1. The representative of a set is its smallest member, whatever the
// order of the joins.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::int32_t{0});
  }

  std::int32_t root(std::int32_t i) const {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];  // halves the path (Tarjan and van Leeuwen 1984)
      i = parent_[i];
    }
    return i;
  }

  void join(std::int32_t i, std::int32_t j) {
    i = root(i);
    j = root(j);
    if (i > j) std::swap(i, j);
    parent_[j] = i;
  }

  std::size_t count() const {
    std::size_t roots = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i)
      if (parent_[i] == static_cast<std::int32_t>(i)) ++roots;
    return roots;
  }

 private:
  mutable std::vector<std::int32_t> parent_;
};

}  // namespace limber
