#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/dynamics/components.h"

namespace limber {

// The components() of a lattice, kept up to date while edges break. A break that separates nothing
// costs a search for the way around it, one that separates two pieces a search through the smaller
// of the two, counted in edges; neither depends on the size of the lattice.
//
// The partition is always that of components(), the labels are not: the piece that comes off gets
// the next free label, the rest keeps the old one.
class ComponentTracker {
 public:
  struct Split {
    std::int32_t from, to;  // labels of what stayed and of what came off it
    bool operator==(const Split&) const = default;
  };

  // Starts from components(lattice). To be called after rebuild_active().
  void reset(const Lattice& lattice);

  // To be told after the breaking operator marked these edges, each once; edges between points that
  // are not dynamic are ignored. Returns what came off, in order of the edges. Of two parts of
  // equal size the one at the edge's larger point comes off. The partition does not depend on the
  // order of the edges.
  std::vector<Split> edges_broken(const Lattice& lattice,
                                  std::span<const std::int32_t> broken_edges);

  const Components& components() const { return components_; }

  // Points of each piece. Shape (components().count).
  const std::vector<std::int32_t>& sizes() const { return sizes_; }

 private:
  // One of the two searches: breadth first, one edge at a time.
  struct Search {
    std::vector<std::int32_t> found;  // points, in the order of finding
    std::size_t from = 0;             // the point of `found` whose edges are looked at
    std::int32_t next = 0;            // into point_edges.items: its edge to look at next
    std::int32_t end = 0;             // one past its last edge
    std::uint32_t mark = 0;           // of the points it found
  };
  enum class Outcome { kSearching, kMet, kExhausted };

  void begin(const Lattice& lattice, Search& search, std::int32_t start, std::uint32_t mark);
  void prefetch_neighbours(const Lattice& lattice) const;
  Outcome look_at_next_edge(const Lattice& lattice, Search& search, const Search& other);
  const Search* separated_by(const Lattice& lattice, std::int32_t edge);
  Split take_off(const Search& part);
  std::uint32_t fresh_marks();

  Components components_;
  std::vector<std::int32_t> sizes_;   // shape (count)
  std::vector<std::uint32_t> marks_;  // shape (P): the search that found the point last
  std::uint32_t last_mark_ = 0;
  std::vector<std::uint8_t> pending_;  // shape (E): broken, but still to be looked at in this call
  std::array<Search, 2> searches_;
};

}  // namespace limber
