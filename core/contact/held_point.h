#pragma once

#include <cstdint>

#include "core/contact/face_contact.h"
#include "core/contact/outer_surface.h"

namespace limber {

// Where a point that has passed through a surface is in relation to it.
struct HeldPlace {
  std::int32_t face = -1;  // the one nearest to it, of those reached from where it came in
  double side = 1.0;       // from which it came: 1 the face's front, -1 its back
  Vec3 weights = Vec3::Zero();
  double height = 0.0;    // m along the face's normal, towards that side: >= 0 is out again
  double distance = 0.0;  // m, to the nearest place of the face
  bool within = false;    // that place is not on a side or corner
};

// The place of a point against one face.
HeldPlace place_against(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
                        std::int32_t face, double side);

// The same after the point has slid on: from face to neighbouring face as long as that is nearer,
// but not round to the other side of what is thin. Of faces that are equally near, as at an edge,
// the one it is most straight above or below.
HeldPlace followed(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
                   const HeldPlace& from);

// Is it on the side it came from, or past the rim of a sheet?
bool is_released(const OuterSurface& surface, const HeldPlace& place);

// The push that brings it back.
FaceContact contact_of(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
                       const HeldPlace& place);

}  // namespace limber
