#pragma once

#include <cstdint>
#include <vector>

#include "core/contact/outer_surface.h"
#include "core/dynamics/lattice.h"

namespace limber {

// Which points may come to pass through which faces within the next substeps.
//
// Points and faces of different pieces are listed when they are nearer than a skin, and anew when
// something can have come half a skin nearer. Those of one piece are listed alike, but what counts
// is how far the piece has deformed; and those that are near each other in the shape as added never
// are. Each pair remembers how far things may move before it has to be looked at: what is
// far apart or at rest costs a comparison every few substeps, the fewer the slower things are.
class NearFaces {
 public:
  struct Pair {
    std::int32_t point, face;
    double clear_to;  // m: the pair cannot touch before its list's way() is this long
  };
  using Pairs = std::vector<Pair>;  // ascending by (point, face)

  // To be called before each substep in which is_due(); `dt`: of the substeps to come, s. `anew`:
  // the surface was rebuilt.
  void refresh(const Lattice& lattice, const OuterSurface& surface, bool anew, double dt);
  bool is_due() const { return substeps_ >= interval_; }

  // Pairs that may touch before the next refresh(), between pieces and within them.
  const Pairs& awake_between() const { return between_.awake; }
  const Pairs& awake_within() const { return within_.awake; }

  // The substep before the next look at the awake pairs: how far they may move in it.
  void advance(double dt);
  bool may_touch_between(const Pair& pair) const { return pair.clear_to <= between_.reach; }
  bool may_touch_within(const Pair& pair) const { return pair.clear_to <= within_.reach; }

  // Of different pieces, nearer than the skin; and those of them that were not so at the last
  // refresh(), if the surface was rebuilt in this one: they may have been inside all along.
  const Pairs& listed_between() const { return between_.pairs; }
  const Pairs& new_between() const { return new_; }

 private:
  struct List {
    Pairs pairs, awake;
    double skin = 0.0;     // m
    double speed = 0.0;    // m/s: no point is faster, against what they have in common
    double way = 0.0;      // m: no point has moved further since way was 0
    double reach = 0.0;    // m: nor will before the substep after this one
    double listed_to = 0;  // m: the list holds as long as way is shorter
  };

  // What the points of a piece have in common.
  struct Frame {
    Vec3 centre, velocity, angular_velocity;
  };

  void find_frames(const Lattice& lattice, const OuterSurface& surface);
  void measure_speeds(const Lattice& lattice, const OuterSurface& surface, double elapsed);
  void choose_interval(const OuterSurface& surface, double dt);
  bool may_fold_over(const Lattice& lattice, const OuterSurface& surface, double ahead) const;
  double lookahead(const List& list, const OuterSurface& surface, double dt) const;
  template <class MakeList>
  void refresh_list(List& list, const Lattice& lattice, const OuterSurface& surface, bool anew,
                    double dt, MakeList make_list) const;
  void wake(List& list, const Lattice& lattice, const OuterSurface& surface, double ahead) const;
  Pairs list_between(const Lattice& lattice, const OuterSurface& surface, double reach) const;
  Pairs list_within(const Lattice& lattice, const OuterSurface& surface, double reach) const;

  List between_, within_;
  Pairs new_;
  std::vector<Frame> frames_;  // shape (groups)
  int refreshes_ = 0;
  int interval_ = 0;  // substeps from one refresh to the next
  int substeps_ = 0;  // since the last one
};

}  // namespace limber
