#pragma once

#include <array>

#include "core/model/vec3.h"

namespace limber {

// A triangle's corners, m. Anticlockwise from its front.
using Triangle = std::array<Vec3, 3>;

// The point of a triangle nearest to some other point.
struct NearestPoint {
  Vec3 weights;                                             // barycentric, each 0..1, their sum 1
  double squared_distance;                                  // m^2
  bool within() const { return weights.minCoeff() > 0.0; }  // not on a side or a corner
  // Is it on the side from corner k to the next? A corner is on two.
  bool on_side(int k) const { return weights[(k + 2) % 3] == 0.0; }
};

// The projection on the plane, or the nearest point of the sides that the projection lies beyond
// (regions as in Ericson, Real-Time Collision Detection, 2005, section 5.1.5). By the normal: his
// differences of products are centimetres wrong for slivers a metre long and 1e-8 m wide, this
// 1e-13 m. Of a triangle without area: the nearest point of its sides.
NearestPoint nearest_on_triangle(const Vec3& point, const Triangle& triangle);

inline Vec3 point_at(const Triangle& triangle, const Vec3& weights) {
  return weights[0] * triangle[0] + weights[1] * triangle[1] + weights[2] * triangle[2];
}

// Twice the area along the normal towards the front, m^2.
inline Vec3 twice_area_vector(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

// Six times the volume of the tetrahedron on it, m^3: positive before the front.
inline double signed_volume(const Vec3& point, const Triangle& triangle) {
  return (point - triangle[0]).dot(twice_area_vector(triangle));
}

// On the plane itself counts as before the front: each place has a side, and only one.
inline bool is_before(const Vec3& point, const Triangle& triangle) {
  return signed_volume(point, triangle) >= 0.0;
}

// Does the line through a and b pass the triangle? Sides count, and a hair beside them does, so
// that nothing slips between two triangles that share one.
bool line_passes(const Triangle& triangle, const Vec3& a, const Vec3& b);

// Gradients of the barycentric weights in the plane, 1/m. Their sum is zero, and the sum of corner
// i times (gradient i . v) is v for every v in the plane. Zero for a triangle without area.
std::array<Vec3, 3> weight_gradients(const Triangle& triangle);

// How a point passes through a triangle while it and the corners move evenly from one place to the
// other.
struct Crossing {
  double time;      // share of the way, 0..1
  bool from_front;  // otherwise from behind
};

struct Crossings {
  std::array<Crossing, 3> at;  // in order of time
  int count = 0;
};

// A point that passes a triangle by less than this share of its size counts as passing through:
// what goes through a seam between two triangles must not slip through for rounding.
inline constexpr double kSeamShare = 1e-7;

// Every passage within the triangle: roots of the cubic (x - a) . ((b - a) x (c - a)) of the time
// at which the four points lie in one plane (Provot, Graphics Interface 1997), each between two of
// its extrema. Whether the sides before and after differ is asked of is_before() alone, so that
// what ends in front of a triangle in one step begins there in the next.
Crossings crossings(const Vec3& point_from, const Vec3& point_to, const Triangle& from,
                    const Triangle& to);

}  // namespace limber
