#pragma once

#include "bullet_bridge/shapes/contact_part.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// What one point has met of one part: where it was a substep ago and through which side it came in.
// All in the frame of the whole shape (the world, for a part that is placed() in it).
struct PointTrack {
  Vec3 last = Vec3::Zero();    // m
  Vec3 normal = Vec3::Zero();  // unit, out of the side it came in through; where inside
  double level = 0.0;          // normal . x of the surface there, m; where swept_through
  std::int64_t triangle = -1;  // under which it is; where inside triangles
  bool inside = false;
  // It went in and out again elsewhere within one substep, and has not been back in since.
  bool swept_through = false;
};

// A track that starts here. A point that is inside already takes the nearest side; of triangles,
// which have no inside, a point is on the side on which it is.
PointTrack start_track(const ContactPart& part, const Vec3& at);

namespace detail {

Penetration follow_near(const ContactPart& part, const Vec3& last, const Vec3& now,
                        PointTrack& track);

inline bool way_misses_bounds(const ContactPart& part, const Vec3& a, const Vec3& b) {
  for (int k = 0; k < 3; ++k) {
    if (a[k] < part.low[k] && b[k] < part.low[k]) return true;
    if (a[k] > part.high[k] && b[k] > part.high[k]) return true;
  }
  return false;
}

}  // namespace detail

// The depth of a point that has moved from track.last to `now`; not above 0: it does not touch.
//
// The way is tested, not only its end: nothing is too thin or too fast. While inside, depth and
// normal are those of the nearest surface that faces within 60 degrees of the side it came in
// through; that side is brought up to date as the point slides around the part. A point that is
// pressed past the middle of a thin part, or beyond it, is led back to where it came from: there
// the depth is the way out along the remembered normal. Whoever stops calling for a while (a point
// far off) sets track.last, or starts the track anew, before the next call.
inline Penetration follow(const ContactPart& part, const Vec3& now, PointTrack& track) {
  const Vec3 last = track.last;
  track.last = now;
  if (!track.inside && detail::way_misses_bounds(part, last, now)) return {-1.0, Vec3::Zero()};
  return detail::follow_near(part, last, now, track);
}

// Is the point outside, as a glance at the part's bounds tells, and has it been on its way? Then
// follow() has nothing to add.
inline bool stays_outside(const ContactPart& part, const Vec3& now, PointTrack& track) {
  if (track.inside || !detail::way_misses_bounds(part, track.last, now)) return false;
  track.last = now;
  return true;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
