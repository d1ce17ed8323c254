#include "core/contact/held_point.h"

#include <algorithm>
#include <cmath>

namespace limber {
namespace {

// A point slides over at most so many faces in a substep.
constexpr int kMostFacesInAStep = 8;

// Distances that differ by less than this share are equal: places on a common edge or corner.
constexpr double kTie = 1e-9;

// Cosines. No face is reached that looks the other way from the one the point is held at: the back
// of a plate is not the way out. One that does not lie straight over the point has to look the same
// way.
constexpr double kSharpestTurn = -0.7;
constexpr double kSameWay = 0.5;

Vec3 unit_normal(const Triangle& triangle) {
  const Vec3 normal = twice_area_vector(triangle);
  const double length = normal.norm();
  return length > 0.0 ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

bool is_better(const HeldPlace& a, const HeldPlace& b) {
  if (a.distance < (1.0 - kTie) * b.distance) return true;
  if (a.distance > (1.0 + kTie) * b.distance) return false;
  return std::abs(a.height) > (1.0 + kTie) * std::abs(b.height);
}

// No neighbour can be nearer than the sides are, as long as the surface turns by less than this:
// the nearest place is further from the sides than twice the depth.
bool is_far_from_sides(const Triangle& triangle, const HeldPlace& place) {
  if (!place.within) return false;
  const double twice_area = twice_area_vector(triangle).norm();
  for (int i = 0; i < 3; ++i) {
    const double side = (triangle[(i + 2) % 3] - triangle[(i + 1) % 3]).norm();
    if (place.weights[i] * twice_area < 2.0 * place.distance * side) return false;
  }
  return true;
}

// The normal towards the side it came from.
Vec3 outwards(const Lattice& lattice, const OuterSurface& surface, const HeldPlace& place) {
  return place.side * unit_normal(surface.triangle(lattice, place.face));
}

// `outward`: of the face it is held at.
HeldPlace best_around(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
                      const HeldPlace& from, const Vec3& outward) {
  HeldPlace best = from;
  for (std::int32_t corner : surface.corners(from.face)) {
    for (std::int32_t face : surface.faces_at(corner)) {
      if (face == from.face || !lattice.breaking.face_external[face]) continue;
      if (surface.is_sheet(face) != surface.is_sheet(from.face)) continue;
      const double turn = surface.same_orientation(from.face, face) ? 1.0 : -1.0;
      const HeldPlace place = place_against(lattice, surface, point, face, turn * from.side);
      if (outwards(lattice, surface, place).dot(outward) < kSharpestTurn) continue;
      if (is_better(place, best)) best = place;
    }
  }
  return best;
}

}  // namespace

HeldPlace place_against(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
                        std::int32_t face, double side) {
  const Triangle triangle = surface.triangle(lattice, face);
  const Vec3& x = lattice.motion[point].position;
  const NearestPoint nearest = nearest_on_triangle(x, triangle);
  HeldPlace place;
  place.face = face;
  place.side = side;
  place.weights = nearest.weights;
  place.distance = std::sqrt(nearest.squared_distance);
  place.within = nearest.within();
  place.height = side * unit_normal(triangle).dot(x - triangle[0]);
  return place;
}

HeldPlace followed(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
                   const HeldPlace& from) {
  const HeldPlace first = place_against(lattice, surface, point, from.face, from.side);
  if (is_far_from_sides(surface.triangle(lattice, first.face), first)) return first;
  const Vec3 outward = outwards(lattice, surface, first);
  HeldPlace place = first;
  for (int n = 0; n < kMostFacesInAStep; ++n) {
    const HeldPlace next = best_around(lattice, surface, point, place, outward);
    if (next.face == place.face) break;
    place = next;
  }
  const bool as_near = place.distance > (1.0 - kTie) * first.distance;
  const bool same_way = outwards(lattice, surface, place).dot(outward) > kSameWay;
  return place.within || as_near || same_way ? place : first;
}

bool is_released(const OuterSurface& surface, const HeldPlace& place) {
  if (place.height >= 0.0) return true;
  if (place.within || !surface.is_sheet(place.face)) return false;
  for (int i = 0; i < 3; ++i) {
    if (place.weights[i] == 0.0 && !surface.continues_beyond(place.face, i)) return true;
  }
  return false;
}

FaceContact contact_of(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
                       const HeldPlace& place) {
  const Triangle triangle = surface.triangle(lattice, place.face);
  FaceContact contact;
  contact.weights = place.weights;
  contact.depth = place.distance;
  contact.normal = place.side * unit_normal(triangle);
  if (!place.within && place.distance > 0.0) {
    const Vec3 way = point_at(triangle, place.weights) - lattice.motion[point].position;
    contact.normal = way / place.distance;
  }
  return contact;
}

}  // namespace limber
