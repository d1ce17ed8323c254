#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/model/vec3.h"

namespace limber {

// Uniform grid over points; finds near pairs without looking at all of them.
class PointGrid {
 public:
  // Cells of `cell_m`, > 0.
  PointGrid(std::span<const Vec3> points, double cell_m) : inverse_cell_(1.0 / cell_m) {
    entries_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      entries_.push_back({cell_of(points[i]), static_cast<std::int32_t>(i)});
    }
    std::sort(entries_.begin(), entries_.end());
  }

  // Calls visit(i, j) once for every pair in the same or in neighbouring cells, in an order that
  // depends on the positions alone.
  template <class Visit>
  void for_each_near_pair(Visit visit) const {
    for (std::size_t first = 0; first < entries_.size();) {
      const std::size_t last = end_of_cell(first);
      pairs_within(first, last, visit);
      // Half of the 26 neighbours: the other half lists the pair from its side. The three cells
      // of a row along z lie side by side in the sorted entries.
      const Cell c = entries_[first].cell;
      pairs_between(first, last, {c.x, c.y, c.z + 1}, {c.x, c.y, c.z + 1}, visit);
      pairs_between(first, last, {c.x, c.y + 1, c.z - 1}, {c.x, c.y + 1, c.z + 1}, visit);
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        pairs_between(first, last, {c.x + 1, c.y + dy, c.z - 1}, {c.x + 1, c.y + dy, c.z + 1},
                      visit);
      }
      first = last;
    }
  }

  // Calls visit(i) once for every point in a cell that the box from `low` to `high` touches, in an
  // order that depends on the positions alone.
  template <class Visit>
  void for_each_around(const Vec3& low, const Vec3& high, Visit visit) const {
    const Cell from = cell_of(low), to = cell_of(high);
    for (std::int64_t x = from.x; x <= to.x; ++x) {
      for (std::int64_t y = from.y; y <= to.y; ++y) {
        auto entry = first_not_before({x, y, from.z});
        for (; entry != entries_.end() && entry->cell <= Cell{x, y, to.z}; ++entry) {
          visit(entry->point);
        }
      }
    }
  }

 private:
  struct Cell {
    std::int64_t x, y, z;
    auto operator<=>(const Cell&) const = default;
  };
  struct Entry {
    Cell cell;
    std::int32_t point;
    auto operator<=>(const Entry&) const = default;
  };

  Cell cell_of(const Vec3& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x() * inverse_cell_)),
            static_cast<std::int64_t>(std::floor(p.y() * inverse_cell_)),
            static_cast<std::int64_t>(std::floor(p.z() * inverse_cell_))};
  }

  std::vector<Entry>::const_iterator first_not_before(const Cell& cell) const {
    return std::lower_bound(entries_.begin(), entries_.end(), cell,
                            [](const Entry& e, const Cell& c) { return e.cell < c; });
  }

  std::size_t end_of_cell(std::size_t first) const {
    std::size_t last = first + 1;
    while (last < entries_.size() && entries_[last].cell == entries_[first].cell) ++last;
    return last;
  }

  template <class Visit>
  void pairs_within(std::size_t first, std::size_t last, Visit& visit) const {
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t j = i + 1; j < last; ++j) visit(entries_[i].point, entries_[j].point);
    }
  }

  template <class Visit>
  void pairs_between(std::size_t first, std::size_t last, const Cell& from, const Cell& to,
                     Visit& visit) const {
    auto other = first_not_before(from);
    for (; other != entries_.end() && other->cell <= to; ++other) {
      for (std::size_t i = first; i < last; ++i) visit(entries_[i].point, other->point);
    }
  }

  double inverse_cell_;
  std::vector<Entry> entries_;
};

}  // namespace limber
