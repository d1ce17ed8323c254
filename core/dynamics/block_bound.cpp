#include "core/dynamics/block_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "core/dynamics/element_shares.h"
#include "core/dynamics/proved_frequency.h"
#include "core/dynamics/regular_grid.h"
#include "core/model/rounded_cache.h"

namespace limber {
namespace {

// A free block of 6 cells a side vibrates 0.1 to 0.3 % faster than a large one, of 4 up to 0.7 %,
// of 2 up to 3 %: blocks are of 5 to 8.
constexpr int kCellsAlongBlock = 6;
// 20 ms each.
constexpr std::size_t kMostKinds = 128;
constexpr std::size_t kMostFactorEntries = 3500000;  // a block has a tenth of that

// Numbers of kinds are rounded to a millionth, a thousand million times what rounding does to equal
// ones, and frequencies of one kind agree to this.
constexpr double kKindError = 1e-5;
constexpr double kKindQuantum = 0x1p-20;

std::int64_t rounded(double x) { return std::llrint(x / kKindQuantum); }

using BlockKey = std::array<int, 4>;  // grid, and place in it

// Cells of one block, or one cell off the grids, or one edge without a cell.
struct Group {
  std::vector<CellId> cells;
  EdgeId alone;
};

// For each point its grid and cell in it; grid -1: none.
IdVector<PointId, BlockKey> places_in(const std::vector<RegularGrid>& grids, std::size_t points) {
  IdVector<PointId, BlockKey> places(points, {-1, 0, 0, 0});
  for (std::size_t g = 0; g < grids.size(); ++g) {
    const RegularGrid& grid = grids[g];
    for (std::int32_t cell = 0; cell < static_cast<std::int32_t>(grid.point.size()); ++cell) {
      if (grid.point[cell] < 0) continue;
      places[PointId(std::size_t(grid.point[cell]))] = {static_cast<int>(g), cell % grid.size[0],
                                                        cell / grid.size[0] % grid.size[1],
                                                        cell / (grid.size[0] * grid.size[1])};
    }
  }
  return places;
}

class Blocks {
 public:
  Blocks(const PhysicalModel& model, const std::vector<RegularGrid>& grids)
      : model_(model),
        sharers_(cells_per_edge(model.geometry)),
        total_(stiffness_around(model)),
        places_(places_in(grids, model.points.size())),
        row_(model.points.size()) {
    for (const RegularGrid& grid : grids) sizes_.push_back(grid.size);
  }

  std::optional<double> largest_frequency() {
    double largest = 0.0;
    for (const Group& group : groups()) {
      read(group);
      if (block_.edges.empty()) continue;
      set_key();
      const std::optional<double>& omega = frequencies_.get(key_, [this] {
        return proved_frequency(scaled_stiffness_bound(block_), kMostFactorEntries);
      });
      if (!omega || frequencies_.kinds() > kMostKinds) return std::nullopt;
      largest = std::max(largest, *omega);
    }
    return largest * (1.0 + kKindError);
  }

 private:
  std::vector<Group> groups() const;
  std::optional<BlockKey> block_of(const Cell& cell) const;
  void read(const Group& group);
  void add_edge(EdgeId e, int cells);
  PointId row_of(PointId p);
  void set_key();

  const PhysicalModel& model_;
  std::vector<std::int32_t> sharers_;  // shape (edges), cells
  IdVector<PointId, double> total_;    // N/m around each point
  IdVector<PointId, BlockKey> places_;
  std::vector<std::array<std::int32_t, 3>> sizes_;  // points along the axes of each grid
  IdVector<PointId, PointId> row_;                  // in block_; none
  PhysicalModel block_;
  RoundedKey key_;
  RoundedCache<std::optional<double>> frequencies_;
};

// Blocks along an axis are as equal as can be.
int block_along(int cell, int cells) {
  const int blocks = std::max(1, (cells + kCellsAlongBlock / 2) / kCellsAlongBlock);
  return cells > 0 ? static_cast<int>(std::int64_t{cell} * blocks / cells) : 0;
}

// The block of a cell's lowest corner; none for a cell that is not within one grid.
std::optional<BlockKey> Blocks::block_of(const Cell& cell) const {
  const int grid = places_[model_.geometry.edges[cell.edges.front()].a][0];
  BlockKey lowest = {grid, 1 << 30, 1 << 30, 1 << 30};
  for (EdgeId e : cell.edges) {
    for (PointId p : {model_.geometry.edges[e].a, model_.geometry.edges[e].b}) {
      if (places_[p][0] != grid) return std::nullopt;
      for (int i = 1; i < 4; ++i) lowest[i] = std::min(lowest[i], places_[p][i]);
    }
  }
  if (grid < 0) return std::nullopt;
  for (int axis = 0; axis < 3; ++axis) {
    lowest[axis + 1] = block_along(lowest[axis + 1], sizes_[grid][axis] - 1);
  }
  return lowest;
}

std::vector<Group> Blocks::groups() const {
  std::vector<Group> groups;
  std::map<BlockKey, std::size_t> known;
  for (CellId c : ids_of(model_.geometry.cells)) {
    const Cell& cell = model_.geometry.cells[c];
    if (cell.edges.empty()) continue;
    const auto block = block_of(cell);
    const std::size_t group =
        block ? known.try_emplace(*block, groups.size()).first->second : groups.size();
    if (group == groups.size()) groups.emplace_back();
    groups[group].cells.push_back(c);
  }
  for (EdgeId e : ids_of(model_.edges)) {
    if (sharers_[e.index()] == 0) groups.push_back({{}, e});
  }
  return groups;
}

void Blocks::read(const Group& group) {
  block_ = {};
  std::vector<EdgeId> edges;
  if (group.alone.valid()) edges.push_back(group.alone);
  for (CellId c : group.cells) {
    const auto& own = model_.geometry.cells[c].edges;
    edges.insert(edges.end(), own.begin(), own.end());
  }
  std::sort(edges.begin(), edges.end());
  std::vector<PointId> points;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::upper_bound(first, edges.end(), *first);
    if (carries(model_.edges[*first])) {
      points.push_back(model_.geometry.edges[*first].a);
      points.push_back(model_.geometry.edges[*first].b);
      add_edge(*first, static_cast<int>(last - first));
    }
    first = last;
  }
  // The springs' sums until here.
  for (PointId p : points) {
    PointId& row = row_[p];
    if (!row.valid()) continue;
    block_.points[row].mass *= model_.points[p].mass / total_[p];
    row = PointId();
  }
}

PointId Blocks::row_of(PointId p) {
  if (!row_[p].valid()) {
    row_[p] = block_.geometry.points.push_back(model_.geometry.points[p]);
    block_.points.push_back({});
  }
  return row_[p];
}

void Blocks::add_edge(EdgeId e, int cells) {
  EdgeAttributes attributes = model_.edges[e];
  attributes.stiffness *= static_cast<double>(cells) / std::max(1, sharers_[e.index()]);
  const Edge edge = {row_of(model_.geometry.edges[e].a), row_of(model_.geometry.edges[e].b)};
  for (PointId p : {edge.a, edge.b}) block_.points[p].mass += attributes.stiffness;
  block_.geometry.edges.push_back(edge);
  block_.edges.push_back(attributes);
}

// Everything that the frequency depends on. Rows are numbered by the edges that come first: blocks
// of a regular lattice, whose edges come in one order, are numbered alike.
void Blocks::set_key() {
  key_.clear();
  for (const PointAttributes& point : block_.points) key_.add(rounded(std::log(point.mass)));
  for (EdgeId e : ids_of(block_.edges)) {
    const auto [a, b] = block_.geometry.edges[e];
    key_.add(a.value);
    key_.add(b.value);
    key_.add(rounded(std::log(block_.edges[e].stiffness)));
    const Vec3 d =
        (block_.geometry.points[b] - block_.geometry.points[a]) / block_.edges[e].rest_length;
    for (int axis = 0; axis < 3; ++axis) key_.add(rounded(d[axis]));
    key_.add(std::int64_t{d.norm() < 0.5});  // sideways_stiffness_bound() jumps there
  }
}

}  // namespace

std::optional<double> block_frequency_bound(const PhysicalModel& model) {
  const std::vector<RegularGrid> grids = regular_grids(model);
  if (grids.empty()) return std::nullopt;
  return Blocks(model, grids).largest_frequency();
}

}  // namespace limber
