#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/penalty.h"
#include "core/dynamics/components.h"
#include "core/dynamics/lattice.h"

namespace limber {

// Point-point penalty collision within and between objects (paper, section 5.1). Two points repel
// when nearer than the sum of their contact radii; points joined by an unbroken edge do not. The
// force is along the line between them: friction across it, between points a contact distance
// apart, would be a couple out of nothing (4 % of the angular momentum of two colliding blocks,
// measured).
//
// Two lists keep the substeps cheap. Pairs of different pieces are found with a uniform grid over
// the points that lie in another piece's bounding box, and listed anew when something has moved
// half of the list's skin. Pairs within a piece keep their distance as long as the piece moves
// rigidly: their list lives until the piece has deformed by half a skin.
class PointContacts {
 public:
  // Lists anew what has to be. `topology_changed`: something broke, or other points are dynamic;
  // `carried_changed`: other points are carried.
  void refresh(const Lattice& lattice, const Components& pieces, bool topology_changed,
               bool carried_changed);

  // Lists the ends of edges that have just broken, each once, at the cost of those edges. Where no
  // piece fell apart this replaces refresh() with `topology_changed`: within a piece all near pairs
  // but the joined ones are listed, and breaking an edge changes for no other pair whether it is
  // near, of one piece, or joined. Where one did, refresh() has to follow.
  void edges_broken(const Lattice& lattice, std::span<const std::int32_t> edges);

  // Goes on with the pairs of another too, which are of other points. refresh() with
  // `topology_changed` has to follow.
  void take_over(PointContacts&& other);

  // Adds the forces of all listed pairs to lattice.force, by what points do just now
  // (penalty_force(): it has two values at rest).
  void add_forces(Lattice& lattice) const;

  // The same for contacts that bear loads (bearing_force()), once a substep of dt, s. lattice.force
  // has to hold all other forces that are known; one pair after the other goes by what those before
  // it have done, and by what surprised it in the substep before. What implicit springs do to a
  // speed is not foreseen: their points are pressed as by add_forces().
  void bear(Lattice& lattice, double dt);

  struct Pair {
    std::int32_t a, b;        // a < b
    double contact_distance;  // m
    double reduced_mass;      // kg
    PenaltyContact law;
    double expected = 0.0;  // m/s: separation speed after the last substep, as foreseen
    bool bears = false;     // it did press in that
  };
  using Pairs = std::vector<Pair>;  // ascending by (a, b)

  // The pairs within pieces as of the last refresh().
  const Pairs& within() const { return within_; }

  std::size_t size() const { return between_.size() + within_.size() + fresh_.size(); }

 private:
  // Points and where they were when a list was made.
  struct Listing {
    std::vector<std::int32_t> points;
    std::vector<Vec3> at;
    void remember(const Lattice& lattice, std::vector<std::int32_t> of);
  };

  void merge_fresh();
  bool moved_too_far(const Lattice& lattice) const;
  bool deformed_too_far(const Lattice& lattice, const Components& pieces) const;
  void list_between(const Lattice& lattice);
  void list_within(const Lattice& lattice);
  template <class Accept>
  Pairs near_pairs(const Lattice& lattice, const std::vector<std::int32_t>& points,
                   Accept accept) const;
  std::vector<std::int32_t> points_near_other_pieces(const Lattice& lattice) const;
  Pair make_pair(const Lattice& lattice, std::int32_t p, std::int32_t q) const;
  double eased_contact_distance(const Lattice& lattice, const Pair* then, std::int32_t p,
                                std::int32_t q, double contact_distance) const;
  const Pair* known(std::int32_t p, std::int32_t q) const;

  Pairs between_, within_;
  // Within pieces too, in order of breaking: inserted one by one they would cost the whole list
  // each.
  Pairs fresh_;
  Pairs old_between_, old_within_;
  Listing between_listing_, within_listing_;
  Components pieces_;  // with carriers
  bool within_stale_ = true;
  int refreshes_ = 0;
  double skin_ = 0.0;  // m
};

}  // namespace limber
