#include "bullet_bridge/shapes/point_track.h"

#include <cmath>

#include "bullet_bridge/shapes/convex_distance.h"
#include "bullet_bridge/shapes/triangle_patch.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

constexpr double kAgree = 0.5;  // cosine of 60 degrees
// A point this near to a mesh when it is first seen lies on it, on the side its triangles face: the
// coordinates of both have been rounded, to 8e-6 m at 100 m in single precision.
constexpr double kOnSurface = 1e-5;  // m

const Penetration kNoTouch{-1.0, Vec3::Zero()};

// What a part says of a point that has come in through the remembered side.
struct Hold {
  enum class Where {
    kTouching,  // under a surface that faces as the side does
    kBeyond,    // past the middle or on the far side: held along the remembered normal
    kOut,       // out again on its own side
    kElsewhere  // beside the part
  };
  Where where = Where::kElsewhere;
  Penetration contact{-1.0, Vec3::Zero()};
};

Penetration plane_penetration(const ContactPart& part, const Vec3& point) {
  return {part.plane_offset - part.plane_normal.dot(point), part.plane_normal};
}

// The way out of a convex part along the normal that is remembered, from inside or from beyond.
Hold way_out(const ContactPart& part, const Vec3& point, const Vec3& normal) {
  const double beyond = (part.own_high - part.own_low).norm() + (point - part.own_low).norm();
  const WayIn back = way_into(part, point + beyond * normal, point);
  if (!back.enters) return {};
  return {Hold::Where::kBeyond, {(1.0 - back.share) * beyond, normal}};
}

Hold hold_of_convex(const ContactPart& part, const Vec3& point, const Vec3& normal) {
  const Penetration nearest = convex_penetration(part, point);
  const double facing = nearest.normal.dot(normal);
  if (nearest.depth > 0.0 && facing > kAgree) return {Hold::Where::kTouching, nearest};
  if (nearest.depth <= 0.0 && facing > 0.0) return {Hold::Where::kOut, nearest};
  return way_out(part, point, normal);
}

Hold hold_of_plane(const ContactPart& part, const Vec3& point) {
  const Penetration contact = plane_penetration(part, point);
  return {contact.depth > 0.0 ? Hold::Where::kTouching : Hold::Where::kOut, contact};
}

// Of the surface around the triangle under which the point is.
Hold hold_of_triangles(const ContactPart& part, const Vec3& point, PointTrack& track,
                       const Vec3& normal) {
  const TrianglePatch& patch = *part.triangles;
  const std::int32_t from = patch.index_of(track.triangle);
  if (from < 0) return {};
  const bool front = patch.triangles()[from].normal.dot(normal) >= 0.0;
  TrianglePatch::Nearest at = patch.nearest_around({from, front}, point, normal);
  if (at.behind && at.on_border) {
    const TriangleSide other = patch.taking_over(at, point, normal);
    if (other.triangle < 0) return {};
    at = patch.nearest_around(other, point, normal);
  }
  const Vec3 facing = patch.facing(at.side);
  const double depth = part.margin + (at.behind ? at.distance : -at.distance);
  if (depth < -part.tolerance) {
    return {facing.dot(normal) > 0.0 ? Hold::Where::kOut : Hold::Where::kElsewhere};
  }
  track.triangle = patch.triangles()[at.side.triangle].key;
  if (track.swept_through && !patch.parted(at.foot, point)) track.swept_through = false;
  // Over a seam without a common edge the planes beside it hold.
  if (at.behind && at.on_border) {
    const double under = std::abs(patch.triangles()[at.side.triangle].height_of(point));
    return {Hold::Where::kTouching, {part.margin + under, facing}};
  }
  // Next to the surface the direction of the gap is lost in rounding.
  if (at.distance <= part.tolerance) return {Hold::Where::kTouching, {depth, facing}};
  const Vec3 gap = at.behind ? at.foot - point : point - at.foot;
  return {Hold::Where::kTouching, {depth, gap / at.distance}};
}

Hold hold_of(const ContactPart& part, const Vec3& point, PointTrack& track, const Vec3& normal) {
  switch (part.kind) {
    case ContactPart::Kind::kPlane:
      return hold_of_plane(part, point);
    case ContactPart::Kind::kTriangles:
      return hold_of_triangles(part, point, track, normal);
    default:
      return hold_of_convex(part, point, normal);
  }
}

WayIn way_into_triangles(const ContactPart& part, const Vec3& a, const Vec3& b, PointTrack& track) {
  const TrianglePatch& patch = *part.triangles;
  const TrianglePatch::Passing passed = patch.first_passed(a, b);
  if (passed.side.triangle >= 0) {
    track.triangle = patch.triangles()[passed.side.triangle].key;
    track.swept_through = passed.again;
    return {true, passed.share, patch.facing(passed.side)};
  }
  if (part.margin <= 0.0) return {};
  const TrianglePatch::Nearest near = patch.nearest_near(b);
  if (near.side.triangle < 0 || near.distance >= part.margin) return {};
  track.triangle = patch.triangles()[near.side.triangle].key;
  if (near.distance <= part.tolerance) return {true, 1.0, patch.facing(near.side)};
  return {true, 1.0, (b - near.foot) / near.distance};
}

WayIn way_into_plane(const ContactPart& part, const Vec3& b) {
  return {plane_penetration(part, b).depth > 0.0, 1.0, part.plane_normal};
}

WayIn way_into_any(const ContactPart& part, const Vec3& a, const Vec3& b, PointTrack& track) {
  switch (part.kind) {
    case ContactPart::Kind::kPlane:
      return way_into_plane(part, b);
    case ContactPart::Kind::kTriangles:
      return way_into_triangles(part, a, b, track);
    default:
      return way_into(part, a, b);
  }
}

Penetration leave(PointTrack& track) {
  track.inside = track.swept_through = false;
  return kNoTouch;
}

Penetration touch(const ContactPart& part, const Penetration& own, const Vec3& now,
                  PointTrack& track) {
  track.inside = true;
  track.normal = part.direction_from_part_frame(own.normal);
  track.level = track.normal.dot(now) + own.depth;
  return {own.depth, track.normal};
}

// A point that has passed a small part within a substep and is where the part's shape says nothing
// of it any more: the plane of entry holds it.
Penetration hold_at_entry(const Vec3& now, PointTrack& track) {
  const double depth = track.level - track.normal.dot(now);
  if (depth <= 0.0) return leave(track);
  track.inside = track.swept_through = true;
  return {depth, track.normal};
}

// The usual answers for spheres without the rest: not near it, or under the surface as before.
bool sphere_at_once(const ContactPart& part, const Vec3& last, const Vec3& now, PointTrack& track,
                    Penetration& answer) {
  const Vec3 b = now - part.position;
  const double squared = b.squaredNorm(), radius_squared = part.radius * part.radius;
  if (!track.inside) {
    // Of the tangent plane under `now`.
    const double along = b.dot(last - part.position);
    answer = kNoTouch;
    return squared > radius_squared && along > 0.0 && along * along > radius_squared * squared;
  }
  if (track.swept_through || squared >= radius_squared || squared <= 0.0) return false;
  const double distance = std::sqrt(squared);
  const Vec3 normal = b / distance;
  if (normal.dot(track.normal) <= kAgree) return false;
  track.normal = normal;
  answer = {part.radius - distance, normal};
  return true;
}

}  // namespace

namespace detail {

Penetration follow_near(const ContactPart& part, const Vec3& last, const Vec3& now,
                        PointTrack& track) {
  Penetration answer;
  if (part.kind == ContactPart::Kind::kSphere && sphere_at_once(part, last, now, track, answer)) {
    return answer;
  }
  const Vec3 b = part.to_part_frame(now);
  const bool was_inside = track.inside;
  if (!was_inside) {
    const Vec3 a = part.to_part_frame(last);
    const WayIn in = way_into_any(part, a, b, track);
    if (!in.enters) return kNoTouch;
    track.normal = part.direction_from_part_frame(in.normal);
    track.level = track.normal.dot(last + in.share * (now - last));
  }
  const Hold hold = hold_of(part, b, track, part.direction_to_part_frame(track.normal));
  switch (hold.where) {
    case Hold::Where::kTouching:
      if (part.kind != ContactPart::Kind::kTriangles) track.swept_through = false;
      return touch(part, hold.contact, now, track);
    case Hold::Where::kBeyond:
      if (!was_inside) track.swept_through = true;
      return touch(part, hold.contact, now, track);
    case Hold::Where::kElsewhere:
      if (!was_inside || track.swept_through) return hold_at_entry(now, track);
      break;
    case Hold::Where::kOut:
      break;
  }
  return leave(track);
}

}  // namespace detail

PointTrack start_track(const ContactPart& part, const Vec3& at) {
  PointTrack track;
  track.last = at;
  const Vec3 own = part.to_part_frame(at);
  if (part.kind == ContactPart::Kind::kTriangles) {
    const TrianglePatch::Nearest near = part.triangles->nearest_near(own);
    if (near.side.triangle < 0 || near.distance > kOnSurface) return track;
    const PatchTriangle& triangle = part.triangles->triangles()[near.side.triangle];
    track.triangle = triangle.key;
    touch(part, {0.0, triangle.normal}, at, track);
    return track;
  }
  const Penetration nearest = part.kind == ContactPart::Kind::kPlane
                                  ? plane_penetration(part, own)
                                  : convex_penetration(part, own);
  if (nearest.depth > 0.0) touch(part, nearest, at, track);
  return track;
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
