#include "core/dynamics/component_tracker.h"

#include <algorithm>
#include <limits>

#include "core/operators/prefetch.h"

namespace limber {

void ComponentTracker::reset(const Lattice& lattice) {
  components_ = limber::components(lattice);
  sizes_.assign(components_.count, 0);
  for (std::int32_t label : components_.label) {
    if (label >= 0) ++sizes_[label];
  }
  marks_.assign(lattice.motion.size(), 0);
  last_mark_ = 0;
  pending_.assign(lattice.springs.size(), 0);
}

// The edges are taken out one after the other, each from a graph that still has those after it:
// then the labels are exact before every step, and an edge whose ends have different labels cannot
// be there. Were all taken out at once, a small part that hung between two large ones by two edges
// would hide by coming off that the large ones have lost their connection.
std::vector<ComponentTracker::Split> ComponentTracker::edges_broken(
    const Lattice& lattice, std::span<const std::int32_t> broken_edges) {
  std::vector<Split> splits;
  for (std::int32_t edge : broken_edges) pending_[edge] = 1;
  for (std::int32_t edge : broken_edges) {
    pending_[edge] = 0;
    if (components_.label[lattice.springs[edge].a] < 0) continue;
    if (const Search* part = separated_by(lattice, edge)) splits.push_back(take_off(*part));
  }
  return splits;
}

// Searches from both ends of the edge in lock-step, edge by edge, so that no more is looked at than
// twice the smaller part. Returns the search that found all of its part, or null where they met.
const ComponentTracker::Search* ComponentTracker::separated_by(const Lattice& lattice,
                                                               std::int32_t edge) {
  const auto [low, high] = std::minmax(lattice.springs[edge].a, lattice.springs[edge].b);
  const std::uint32_t mark = fresh_marks();
  begin(lattice, searches_[0], high, mark);
  begin(lattice, searches_[1], low, mark + 1);
  prefetch_neighbours(lattice);
  for (int side = 0;; side = 1 - side) {
    const Outcome outcome = look_at_next_edge(lattice, searches_[side], searches_[1 - side]);
    if (outcome == Outcome::kMet) return nullptr;
    if (outcome == Outcome::kExhausted) return &searches_[side];
  }
}

void ComponentTracker::begin(const Lattice& lattice, Search& search, std::int32_t start,
                             std::uint32_t mark) {
  search.found.assign(1, start);
  search.from = 0;
  search.next = lattice.point_edges.start[start];
  search.end = lattice.point_edges.start[start + 1];
  search.mark = mark;
  marks_[start] = mark;
  prefetch(&lattice.point_edges.items[search.next]);
  prefetch(&lattice.point_neighbours[search.next]);
}

// The way around a broken edge is short: of both ends, the first neighbours and their edges.
void ComponentTracker::prefetch_neighbours(const Lattice& lattice) const {
  constexpr std::int32_t kMost = 6;
  const auto for_each = [&](auto visit) {
    for (const Search& search : searches_) {
      const std::int32_t end = std::min(search.end, search.next + kMost);
      for (std::int32_t i = search.next; i < end; ++i) visit(i);
    }
  };
  for_each([&](std::int32_t i) {
    prefetch(&lattice.point_edges.start[lattice.point_neighbours[i]]);
    prefetch(&marks_[lattice.point_neighbours[i]]);
    prefetch(&lattice.breaking.edge_broken[lattice.point_edges.items[i]]);
  });
  for_each([&](std::int32_t i) {
    const std::int32_t first = lattice.point_edges.start[lattice.point_neighbours[i]];
    prefetch(&lattice.point_edges.items[first]);
    prefetch(&lattice.point_neighbours[first]);
  });
}

ComponentTracker::Outcome ComponentTracker::look_at_next_edge(const Lattice& lattice,
                                                              Search& search, const Search& other) {
  while (search.next == search.end) {
    if (++search.from == search.found.size()) return Outcome::kExhausted;
    const std::int32_t point = search.found[search.from];
    search.next = lattice.point_edges.start[point];
    search.end = lattice.point_edges.start[point + 1];
  }
  const std::int32_t i = search.next++;
  const std::int32_t edge = lattice.point_edges.items[i];
  const std::int32_t neighbour = lattice.point_neighbours[i];
  if (marks_[neighbour] == search.mark) return Outcome::kSearching;
  if (lattice.breaking.edge_broken[edge] && !pending_[edge]) return Outcome::kSearching;
  if (marks_[neighbour] == other.mark) return Outcome::kMet;
  marks_[neighbour] = search.mark;
  search.found.push_back(neighbour);
  return Outcome::kSearching;
}

ComponentTracker::Split ComponentTracker::take_off(const Search& part) {
  const Split split{components_.label[part.found[0]], components_.count++};
  for (std::int32_t point : part.found) components_.label[point] = split.to;
  sizes_.push_back(static_cast<std::int32_t>(part.found.size()));
  sizes_[split.from] -= sizes_.back();
  return split;
}

// Two marks that no point bears, so that nothing has to be cleared between searches.
std::uint32_t ComponentTracker::fresh_marks() {
  if (last_mark_ > std::numeric_limits<std::uint32_t>::max() - 2) {
    std::fill(marks_.begin(), marks_.end(), 0);
    last_mark_ = 0;
  }
  last_mark_ += 2;
  return last_mark_ - 1;
}

}  // namespace limber
