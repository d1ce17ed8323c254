#include "core/contact/near_faces.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/contact/piece_boxes.h"
#include "core/contact/point_grid.h"
#include "core/dynamics/rigid_motion.h"
#include "core/model/bounds.h"

namespace limber {
namespace {

// Points this near to a face's centre in the shape as added, in its longest sides, belong to its
// own surroundings.
constexpr double kSurroundings = 1.5;

// The least skin as a share of a face's size, and the least way that things at rest are expected to
// move between two refreshes.
constexpr double kSkinShare = 0.5;
constexpr double kRestShare = 0.02;

// How much faster than the fastest a point may become between two refreshes: one that is hit by
// something heavy leaves at twice its speed.
constexpr double kSpeedMargin = 2.0;

// Substeps between two refreshes: as many as the fastest points take for this share of a face's
// size.
constexpr double kWayShare = 0.1;
constexpr double kMostSubsteps = 16;

// Refreshes between two looks at how pieces move as a whole.
constexpr int kFrameInterval = 8;

// Cells of the grid, in what a face reaches to: smaller ones are more to look up, larger ones hold
// more points that are out of reach (the teapot's listings take 1.4 times as long at 1).
constexpr double kCellShare = 0.5;

bool by_point_and_face(const NearFaces::Pair& l, const NearFaces::Pair& r) {
  return l.point != r.point ? l.point < r.point : l.face < r.face;
}

bool is_dynamic(const Lattice& lattice, std::int32_t p) {
  return lattice.role[p] == PointRole::kDynamic;
}

// Does contact count for them at all? Two bodies' points are their own engine's business.
bool can_touch(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
               std::int32_t face) {
  const std::int32_t corner = surface.corners(face)[0];
  const double radii = lattice.contact_radius[point] + lattice.contact_radius[corner];
  return radii > 0.0 && (is_dynamic(lattice, point) || is_dynamic(lattice, corner));
}

double distance_to(const Lattice& lattice, const OuterSurface& surface, const NearFaces::Pair& p) {
  const Triangle triangle = surface.triangle(lattice, p.face);
  return std::sqrt(
      nearest_on_triangle(lattice.motion[p.point].position, triangle).squared_distance);
}

// A lower bound of the distance, m, at a fraction of the cost: by the ball around the triangle's
// first corner.
double least_distance_to(const Lattice& lattice, const OuterSurface& surface,
                         const NearFaces::Pair& p) {
  const Triangle t = surface.triangle(lattice, p.face);
  const double squared = std::max((t[1] - t[0]).squaredNorm(), (t[2] - t[0]).squaredNorm());
  return (lattice.motion[p.point].position - t[0]).norm() - std::sqrt(squared);
}

// Appends the pairs of these points and faces that are nearer than `reach` and that accept(point,
// face) takes. Their clear_to is half their distance.
template <class Accept>
void append_near(const Lattice& lattice, const OuterSurface& surface,
                 const std::vector<std::int32_t>& points, const std::vector<std::int32_t>& faces,
                 double reach, Accept accept, NearFaces::Pairs& pairs) {
  if (points.empty() || faces.empty()) return;
  std::vector<Vec3> at;
  for (std::int32_t p : points) at.push_back(lattice.motion[p].position);
  const PointGrid grid(at, kCellShare * (surface.mean_face_size() + reach));
  for (std::int32_t f : faces) {
    const Triangle triangle = surface.triangle(lattice, f);
    const Box3 box = bounds_of(triangle);
    const Vec3 around = Vec3::Constant(reach);
    grid.for_each_around(box.min() - around, box.max() + around, [&](std::int32_t i) {
      if (!accept(points[i], f) || box.squaredExteriorDistance(at[i]) > reach * reach) return;
      const double squared = nearest_on_triangle(at[i], triangle).squared_distance;
      if (squared > reach * reach) return;
      pairs.push_back({points[i], f, 0.5 * std::sqrt(squared)});
    });
  }
}

template <class Keep>
std::vector<std::int32_t> kept(const std::vector<std::int32_t>& all, Keep keep) {
  std::vector<std::int32_t> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), keep);
  return some;
}

bool are_apart_at_rest(const Lattice& lattice, const OuterSurface& surface, std::int32_t point,
                       std::int32_t face) {
  const Triangle t = surface.authored_triangle(lattice, face);
  const double side = std::max(
      {(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()});
  const Vec3 way = lattice.authored_position[point] - (t[0] + t[1] + t[2]) / 3.0;
  return way.squaredNorm() > kSurroundings * kSurroundings * side;
}

}  // namespace

void NearFaces::refresh(const Lattice& lattice, const OuterSurface& surface, bool anew, double dt) {
  new_.clear();
  if (surface.faces().empty()) {
    between_ = within_ = List{};
    interval_ = substeps_ = 0;
    return;
  }
  if (anew || refreshes_++ % kFrameInterval == 0) find_frames(lattice, surface);
  measure_speeds(lattice, surface, substeps_ * dt);
  choose_interval(surface, dt);
  const Pairs before = anew ? between_.pairs : Pairs{};
  refresh_list(between_, lattice, surface, anew, dt,
               [&](double reach) { return list_between(lattice, surface, reach); });
  if (may_fold_over(lattice, surface, lookahead(within_, surface, dt))) {
    refresh_list(within_, lattice, surface, anew, dt,
                 [&](double reach) { return list_within(lattice, surface, reach); });
  } else {
    const double speed = within_.speed;
    within_ = List{};
    within_.speed = speed;
  }
  if (anew) {
    std::set_difference(between_.pairs.begin(), between_.pairs.end(), before.begin(), before.end(),
                        std::back_inserter(new_), by_point_and_face);
  }
}

void NearFaces::advance(double dt) {
  ++substeps_;
  for (List* list : {&between_, &within_}) {
    list->way += list->speed * dt;
    list->reach += kSpeedMargin * list->speed * dt;
  }
}

// Has a piece with sheets lost its shape by so much that a point may come to a face that was out of
// its surroundings, or may do so on a way of `ahead`? Most pieces never do: this is a pass over
// their points, where a list of what is near each other costs a hundred times as much.
bool NearFaces::may_fold_over(const Lattice& lattice, const OuterSurface& surface,
                              double ahead) const {
  // From a face's centre to its farthest corner are up to 2/3 of its longest side.
  const double apart = (kSurroundings - 2.0 / 3.0) * surface.least_face_size();
  const double most = 0.5 * apart - ahead;
  std::vector<bool> has_sheet(static_cast<std::size_t>(surface.groups()), false);
  for (std::int32_t f : surface.faces()) {
    if (surface.is_sheet(f)) has_sheet[surface.group_of_face(f)] = true;
  }
  if (std::find(has_sheet.begin(), has_sheet.end(), true) == has_sheet.end()) return false;
  if (most <= 0.0) return true;
  std::vector<std::vector<std::int32_t>> points(static_cast<std::size_t>(surface.groups()));
  for (std::int32_t p : surface.points()) points[surface.group(p)].push_back(p);
  for (const auto& of : points) {
    if (of.size() < 2 || !has_sheet[surface.group(of[0])]) continue;
    const Mat3 rotation =
        best_rotation(lattice.motion, lattice.authored_position, lattice.mass, of);
    const Vec3 from = lattice.authored_position[of[0]], to = lattice.motion[of[0]].position;
    for (std::int32_t p : of) {
      const Vec3 rigid = to + rotation * (lattice.authored_position[p] - from);
      if ((lattice.motion[p].position - rigid).squaredNorm() > most * most) return true;
    }
  }
  return false;
}

// Rigid motions of the pieces' surfaces.
void NearFaces::find_frames(const Lattice& lattice, const OuterSurface& surface) {
  std::vector<std::vector<std::int32_t>> points(static_cast<std::size_t>(surface.groups()));
  for (std::int32_t p : surface.points()) points[surface.group(p)].push_back(p);
  frames_.clear();
  for (const auto& of : points) {
    if (of.empty()) {
      frames_.push_back({Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
      continue;
    }
    const RigidMotion motion = rigid_motion(lattice.motion, lattice.mass, of);
    frames_.push_back({motion.centre, motion.velocity, motion.angular_velocity});
  }
}

// Against the mean velocity for what is between pieces, against their rigid motions for what is
// within. Which one is taken makes no difference to what they bound.
void NearFaces::measure_speeds(const Lattice& lattice, const OuterSurface& surface,
                               double elapsed) {
  const std::vector<std::int32_t>& points = surface.points();
  Vec3 mean = Vec3::Zero();
  for (std::int32_t p : points) mean += lattice.motion[p].velocity;
  mean /= static_cast<double>(std::max<std::size_t>(1, points.size()));
  for (Frame& frame : frames_) frame.centre += frame.velocity * elapsed;
  double between = 0.0, within = 0.0;
  for (std::int32_t p : points) {
    const auto& [x, v] = lattice.motion[p];
    between = std::max(between, (v - mean).squaredNorm());
    if (surface.faces_at(p).empty()) continue;
    const Frame& frame = frames_[surface.group(p)];
    const Vec3 rigid = frame.velocity + frame.angular_velocity.cross(x - frame.centre);
    within = std::max(within, (v - rigid).squaredNorm());
  }
  // What got faster since the last time has moved further than was counted.
  between_.way += std::max(0.0, std::sqrt(between) - between_.speed) * elapsed;
  within_.way += std::max(0.0, std::sqrt(within) - within_.speed) * elapsed;
  between_.speed = std::sqrt(between);
  within_.speed = std::sqrt(within);
}

void NearFaces::choose_interval(const OuterSurface& surface, double dt) {
  const double way = std::max(between_.speed, within_.speed) * dt;  // in a substep
  const double share = kWayShare * surface.mean_face_size();
  interval_ = share < kMostSubsteps * way ? std::max(1, static_cast<int>(share / way))
                                          : static_cast<int>(kMostSubsteps);
  substeps_ = 0;
}

double NearFaces::lookahead(const List& list, const OuterSurface& surface, double dt) const {
  return kRestShare * surface.mean_face_size() + kSpeedMargin * list.speed * interval_ * dt;
}

template <class MakeList>
void NearFaces::refresh_list(List& list, const Lattice& lattice, const OuterSurface& surface,
                             bool anew, double dt, MakeList make_list) const {
  const double ahead = lookahead(list, surface, dt);
  if (anew || list.way + ahead > list.listed_to) {
    list.skin = kSkinShare * surface.mean_face_size() + 4.0 * ahead;
    list.pairs = make_list(list.skin);
    list.way = 0.0;
    list.listed_to = 0.5 * list.skin;
  }
  wake(list, lattice, surface, ahead);
  list.reach = list.way + kRestShare * surface.mean_face_size();
}

void NearFaces::wake(List& list, const Lattice& lattice, const OuterSurface& surface,
                     double ahead) const {
  list.awake.clear();
  for (Pair& pair : list.pairs) {
    if (pair.clear_to > list.way + ahead) continue;
    const double bound = 0.5 * least_distance_to(lattice, surface, pair);
    pair.clear_to = list.way + (bound > ahead ? bound : 0.5 * distance_to(lattice, surface, pair));
    if (pair.clear_to <= list.way + ahead) list.awake.push_back(pair);
  }
}

// Only what reaches into another piece's box can meet it.
NearFaces::Pairs NearFaces::list_between(const Lattice& lattice, const OuterSurface& surface,
                                         double reach) const {
  const auto accept = [&](std::int32_t p, std::int32_t f) {
    return surface.group(p) != surface.group_of_face(f) && can_touch(lattice, surface, p, f);
  };
  Pairs pairs;
  if (PieceBoxes::pay(surface.groups(), surface.points().size())) {
    const PieceBoxes boxes(lattice, surface.points(), surface.pieces(), reach);
    const auto points = kept(surface.points(), [&](std::int32_t p) {
      const Vec3& x = lattice.motion[p].position;
      return boxes.reaches_into_another(Box3(x, x), surface.group(p));
    });
    if (points.empty()) return pairs;
    const auto faces = kept(surface.faces(), [&](std::int32_t f) {
      const Box3 box = bounds_of(surface.triangle(lattice, f));
      return boxes.reaches_into_another(box, surface.group_of_face(f));
    });
    append_near(lattice, surface, points, faces, reach, accept, pairs);
  } else {
    append_near(lattice, surface, surface.points(), surface.faces(), reach, accept, pairs);
  }
  std::sort(pairs.begin(), pairs.end(), by_point_and_face);
  return pairs;
}

// Of sheets alone: they fold at next to no strain. Solids would have to be bent double; their
// points meet each other by the point-point penalty.
NearFaces::Pairs NearFaces::list_within(const Lattice& lattice, const OuterSurface& surface,
                                        double reach) const {
  Pairs pairs;
  const auto faces = kept(surface.faces(), [&](std::int32_t f) { return surface.is_sheet(f); });
  const auto points =
      kept(surface.points(), [&](std::int32_t p) { return !surface.faces_at(p).empty(); });
  append_near(
      lattice, surface, points, faces, reach,
      [&](std::int32_t p, std::int32_t f) {
        return surface.group(p) == surface.group_of_face(f) && can_touch(lattice, surface, p, f) &&
               are_apart_at_rest(lattice, surface, p, f);
      },
      pairs);
  std::sort(pairs.begin(), pairs.end(), by_point_and_face);
  return pairs;
}

}  // namespace limber
