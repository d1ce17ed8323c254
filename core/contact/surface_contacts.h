#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/held_point.h"
#include "core/contact/near_faces.h"
#include "core/contact/outer_surface.h"
#include "core/contact/passive_contact.h"
#include "core/contact/penalty.h"
#include "core/dynamics/components.h"
#include "core/dynamics/lattice.h"

namespace limber {

// Contact of points with the outer faces of other pieces, and of their own where it is folded onto
// itself; beside the point-point penalty, which keeps lattices apart whose points are about as far
// from each other. What slips through that one, for it is finer, thinner or fast, meets the faces.
//
// A face has no thickness: it takes hold of a point that passes through it. Passages are found
// whatever the speed, by following point and corners from substep to substep. From then on the
// point is pushed back to the side it came from, by a penalty spring as deep as it is behind the
// surface, however deep that is, until it is back or the face broke; over the edges of the surface
// it slides. So nothing passes a face that holds.
//
// Springs of many points on one face share its corners' masses (contact_mass() of face_contact.h),
// so that all of them together stay below one frequency: that of the point-point penalty, or what
// the step has to spare if that is less. A contact never gives back more energy than it took.
// Coulomb friction acts across the face. Momentum and angular momentum are kept.
//
// Points that are found behind a face without having passed through it (a piece that thaws inside
// another one) are eased out slowly.
class SurfaceContacts {
 public:
  // In the first substep, and whenever something may have changed. `topology_changed`: something
  // fell apart, or other points are dynamic; `carried_changed`: other points are carried.
  void refresh(const Lattice& lattice, const Components& pieces, bool topology_changed,
               bool carried_changed);

  // Edges broke: faces have gone and come. Needs no refresh() with `topology_changed` unless a
  // piece fell apart.
  void edges_broken() { broken_ = true; }

  // Goes on with the held points of another too, which are others. refresh() with
  // `topology_changed` has to follow.
  void take_over(SurfaceContacts&& other, const Lattice& lattice);

  // Adds the forces on all held points and the corners that hold them to lattice.force. Once a
  // substep of dt, s.
  void add_forces(Lattice& lattice, double dt);

  // A point behind a face it came through.
  struct Held {
    std::int32_t point = -1;
    HeldPlace place;
    int exits = 0;        // passages out of the same solid elsewhere, as through a plate's back
    double offset = 0.0;  // m of depth that was there at first
    PassiveContact books;
    FaceContact contact;  // of the last substep
    bool released = false;
  };

  // Ascending by point.
  std::span<const Held> held() const { return held_; }

  // Pairs that are looked at in every substep.
  std::size_t watched() const { return near_.awake_between().size() + near_.awake_within().size(); }

 private:
  struct Passage {
    std::int32_t point;
    double time;
    std::int32_t face;
    bool from_front;
  };

  void rebuild_surface(const Lattice& lattice, const Components& pieces);
  void find_passages(const Lattice& lattice);
  void find_passages_of(const Lattice& lattice, const NearFaces::Pairs& pairs, bool within);
  void take_hold();
  bool is_known(const Passage& passage, std::span<Held> held_here);
  void remember_positions(const Lattice& lattice);
  void watch_awake(const Lattice& lattice);
  void hold_what_is_inside(const Lattice& lattice);
  bool is_inside(const Lattice& lattice, std::span<const NearFaces::Pair> pairs_of_point,
                 std::int32_t group, HeldPlace& place) const;
  void follow(const Lattice& lattice);
  void count_shares();
  void push(Lattice& lattice, Held& held, double dt);
  PenaltyContact law_of(const Lattice& lattice, const Held& held, double dt) const;
  FaceMotion motion_of(const Lattice& lattice, const Held& held) const;
  FaceMotion motion_after(const Lattice& lattice, const Held& held, double dt) const;
  FaceMobility mobility_of(const Lattice& lattice, const Held& held) const;

  OuterSurface surface_;
  NearFaces near_;
  std::vector<Held> held_;
  std::vector<Passage> passages_;
  std::vector<Vec3> previous_;            // shape (P): of watched points, where they were
  std::vector<std::int32_t> watched_;     // points of awake pairs
  std::vector<std::uint8_t> is_watched_;  // shape (P)
  std::vector<std::int32_t> shares_;      // shape (P): contacts that act on each point
  bool rebuilt_ = false;                  // the surface, and the lists of what is near it are not
  bool started_ = false;
  bool broken_ = false;
  int refreshes_since_break_ = 0;
};

}  // namespace limber
