#include "core/dynamics/regular_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/model/point_edges.h"

namespace limber {

namespace {

// Fewer springs than this are done before a stencil has begun.
constexpr std::size_t kLeastSprings = 256;
// A cell of the grid, with a point or without, costs as much as two springs by themselves: measured
// as springs/lattice and springs/edges.
constexpr std::size_t kLeastSpringsPerCell = 2;
constexpr double kMostCellsPerPoint = 13.0 / kLeastSpringsPerCell;
// How far, in steps, an edge may lie from the step it is taken for.
constexpr double kStepTolerance = 0.2;
// Edges along the axes are this close to square to each other.
constexpr double kSquareTolerance = 0.3;
// Constants and rest lengths that differ by less are equal: single precision knows no better.
constexpr double kEqual = 1e-8;

bool nearly_equal(double a, double b) { return std::abs(a - b) <= kEqual * std::abs(a); }

constexpr std::int32_t kNoFlood = -1;      // not reached yet
constexpr std::int32_t kFitsNowhere = -2;  // its cell is taken

struct Axis {
  Vec3 step;                 // m
  std::int32_t id_step = 0;  // from a point's id to that of the next along the axis
};

// Shortest first; then in the order in which points are numbered, so that the grid's is like it.
bool comes_before(const Axis& a, const Axis& b) {
  const double length = a.step.norm(), other = b.step.norm();
  if (!nearly_equal(length, other)) return length < other;
  if (std::abs(a.id_step) != std::abs(b.id_step)) return std::abs(a.id_step) < std::abs(b.id_step);
  return a.id_step > b.id_step;
}

bool square_to(const std::vector<Axis>& axes, const Vec3& d) {
  return std::all_of(axes.begin(), axes.end(), [&](const Axis& axis) {
    return std::abs(axis.step.dot(d)) <= kSquareTolerance * axis.step.norm() * d.norm();
  });
}

// From metres to steps along the axes. A flat lattice has two axes: the third may be any.
Mat3 to_steps(std::vector<Axis> axes) {
  std::sort(axes.begin(), axes.end(),
            [](const Axis& a, const Axis& b) { return std::abs(a.id_step) < std::abs(b.id_step); });
  Mat3 steps = Mat3::Identity();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    steps.col(i) = axes[i].id_step > 0 ? axes[i].step : Vec3(-axes[i].step);
  }
  if (axes.size() == 2) {
    steps.col(2) = steps.col(0).cross(steps.col(1)).normalized() * steps.col(0).norm();
  }
  return steps.inverse();
}

GridStep sum(const GridStep& a, const GridStep& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

std::optional<GridStep> step_of(const Mat3& to_steps, const Vec3& displacement) {
  const Vec3 steps = to_steps * displacement;
  GridStep step;
  for (int axis = 0; axis < 3; ++axis) {
    const double nearest = std::round(steps[axis]);
    // Also false for what is not a number.
    if (!(std::abs(nearest) <= 1.0 && std::abs(steps[axis] - nearest) < kStepTolerance)) {
      return std::nullopt;
    }
    step[axis] = static_cast<int>(nearest);
  }
  return step;
}

int direction_of(const GridStep& step) {
  for (int d = 0; d < kGridDirections; ++d) {
    if (kGridSteps[d] == step) return d;
  }
  return -1;
}

std::int32_t class_of(std::vector<SpringClass>& classes, const EdgeAttributes& edge) {
  for (std::size_t c = 0; c < classes.size(); ++c) {
    SpringClass& known = classes[c];
    if (!nearly_equal(known.stiffness, edge.stiffness)) continue;
    if (!nearly_equal(known.damping, edge.damping)) continue;
    known.break_threshold = std::min(known.break_threshold, edge.break_threshold);
    known.crush_threshold = std::min(known.crush_threshold, edge.crush_threshold);
    return static_cast<std::int32_t>(c);
  }
  if (classes.size() == kMostSpringClasses) return -1;
  classes.push_back({edge.stiffness, edge.damping, edge.break_threshold, edge.crush_threshold});
  return static_cast<std::int32_t>(classes.size() - 1);
}

bool worth_it(const RegularGrid& grid) {
  return grid.springs.size() >= kLeastSprings &&
         grid.springs.size() >= kLeastSpringsPerCell * grid.point.size();
}

class Grower {
 public:
  explicit Grower(const PhysicalModel& model)
      : model_(model),
        edges_of_(point_edges(model.geometry)),
        at_(model.points.size()),
        flood_of_(model.points.size(), kNoFlood) {}

  std::vector<RegularGrid> all();

 private:
  std::vector<PointId> seeds() const;
  PointId other_end(EdgeId e, PointId p) const;
  Vec3 along(EdgeId e, PointId from) const;
  std::vector<Axis> axes_at(PointId p) const;
  std::vector<PointId> flood(PointId seed, const Mat3& to_steps);
  bool count_from_corner(const std::vector<PointId>& points);
  RegularGrid grid_of(const std::vector<PointId>& points);
  RegularGrid* grid_with(std::vector<RegularGrid>& grids, EdgeId e) const;
  int half_of(EdgeId e) const;
  void choose_rest_lengths(std::vector<RegularGrid>& grids) const;
  void add_spring(RegularGrid& grid, EdgeId e) const;

  const PhysicalModel& model_;
  IndexRows edges_of_;
  IdVector<PointId, GridStep> at_;
  IdVector<PointId, std::int32_t> flood_of_;
};

std::vector<PointId> Grower::seeds() const {
  std::vector<PointId> seeds;
  for (PointId p : ids_of(model_.points)) seeds.push_back(p);
  std::stable_sort(seeds.begin(), seeds.end(), [&](PointId p, PointId q) {
    return edges_of_[p.index()].size() > edges_of_[q.index()].size();
  });
  return seeds;
}

PointId Grower::other_end(EdgeId e, PointId p) const {
  const Edge& edge = model_.geometry.edges[e];
  return edge.a == p ? edge.b : edge.a;
}

Vec3 Grower::along(EdgeId e, PointId from) const {
  return model_.geometry.points[other_end(e, from)] - model_.geometry.points[from];
}

// The shortest edges that are square to each other.
std::vector<Axis> Grower::axes_at(PointId p) const {
  std::vector<Axis> axes;
  while (axes.size() < 3) {
    std::optional<Axis> best;
    for (std::int32_t item : edges_of_[p.index()]) {
      const EdgeId e{std::size_t(item)};
      const Axis axis = {along(e, p), other_end(e, p).value - p.value};
      if (!(axis.step.norm() > 0.0) || !square_to(axes, axis.step)) continue;
      if (!best || comes_before(axis, *best)) best = axis;
    }
    if (!best) break;
    axes.push_back(*best);
  }
  return axes;
}

std::vector<PointId> Grower::flood(PointId seed, const Mat3& to_steps) {
  const std::int32_t mark = flood_of_[seed];
  std::vector<PointId> points = {seed};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointId p = points[i];
    for (std::int32_t item : edges_of_[p.index()]) {
      const PointId q = other_end(EdgeId(std::size_t(item)), p);
      if (flood_of_[q] != kNoFlood) continue;
      const auto step = step_of(to_steps, along(EdgeId(std::size_t(item)), p));
      if (!step) continue;
      at_[q] = sum(at_[p], *step);
      flood_of_[q] = mark;
      points.push_back(q);
    }
  }
  return points;
}

// False where the box around them is too large to be worth it.
bool Grower::count_from_corner(const std::vector<PointId>& points) {
  GridStep low = at_[points[0]], high = low;
  for (PointId p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], at_[p][axis]);
      high[axis] = std::max(high[axis], at_[p][axis]);
    }
  }
  double cells = 1.0;
  for (int axis = 0; axis < 3; ++axis) cells *= high[axis] - low[axis] + 1.0;
  for (PointId p : points) at_[p] = sum(at_[p], {-low[0], -low[1], -low[2]});
  return cells <= kMostCellsPerPoint * double(points.size());
}

RegularGrid Grower::grid_of(const std::vector<PointId>& points) {
  RegularGrid grid;
  GridStep high = {0, 0, 0};
  for (PointId p : points) {
    for (int axis = 0; axis < 3; ++axis) high[axis] = std::max(high[axis], at_[p][axis]);
  }
  grid.size = {high[0] + 1, high[1] + 1, high[2] + 1};
  grid.point.assign(std::size_t(grid.size[0]) * grid.size[1] * grid.size[2], -1);
  for (PointId p : points) {
    std::int32_t& taken = grid.point[grid.cell_of(at_[p])];
    if (taken < 0) {
      taken = p.value;
    } else {
      flood_of_[p] = kFitsNowhere;
    }
  }
  return grid;
}

// The grid that has both ends of the edge; null where there is none.
RegularGrid* Grower::grid_with(std::vector<RegularGrid>& grids, EdgeId e) const {
  const Edge& edge = model_.geometry.edges[e];
  const std::int32_t flood = flood_of_[edge.a];
  if (flood < 0 || flood != flood_of_[edge.b] || grids[flood].point.empty()) return nullptr;
  return &grids[flood];
}

// As in GridSpring; -1 where the edge is no step.
int Grower::half_of(EdgeId e) const {
  const Edge& edge = model_.geometry.edges[e];
  const GridStep &a = at_[edge.a], &b = at_[edge.b];
  const int on = direction_of({b[0] - a[0], b[1] - a[1], b[2] - a[2]});
  if (on >= 0) return 2 * on;
  const int back = direction_of({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
  return back >= 0 ? 2 * back + 1 : -1;
}

// In each direction the one that most springs have (Boyer and Moore's majority vote).
void Grower::choose_rest_lengths(std::vector<RegularGrid>& grids) const {
  std::vector<std::array<std::int32_t, kGridDirections>> votes(grids.size());
  for (EdgeId e : ids_of(model_.geometry.edges)) {
    RegularGrid* grid = grid_with(grids, e);
    const int half = grid ? half_of(e) : -1;
    if (half < 0) continue;
    double& rest = grid->rest_length[half / 2];
    std::int32_t& lead = votes[grid - grids.data()][half / 2];
    if (lead == 0) rest = model_.edges[e].rest_length;
    lead += nearly_equal(rest, model_.edges[e].rest_length) ? 1 : -1;
  }
}

void Grower::add_spring(RegularGrid& grid, EdgeId e) const {
  const EdgeAttributes& attributes = model_.edges[e];
  const int half = half_of(e);
  if (half < 0 || !nearly_equal(grid.rest_length[half / 2], attributes.rest_length)) return;
  const std::int32_t spring_class = class_of(grid.classes[half / 2], attributes);
  if (spring_class < 0) return;
  grid.springs.push_back({e, grid.cell_of(at_[model_.geometry.edges[e].a]),
                          static_cast<std::uint8_t>(half),
                          static_cast<std::uint8_t>(spring_class)});
}

std::vector<RegularGrid> Grower::all() {
  std::vector<RegularGrid> grids;
  for (PointId seed : seeds()) {
    if (flood_of_[seed] != kNoFlood) continue;
    const std::vector<Axis> axes = axes_at(seed);
    if (axes.size() < 2) continue;
    flood_of_[seed] = static_cast<std::int32_t>(grids.size());
    at_[seed] = {0, 0, 0};
    const std::vector<PointId> points = flood(seed, to_steps(axes));
    grids.push_back(count_from_corner(points) ? grid_of(points) : RegularGrid{});
  }
  choose_rest_lengths(grids);
  for (EdgeId e : ids_of(model_.geometry.edges)) {
    if (RegularGrid* grid = grid_with(grids, e)) add_spring(*grid, e);
  }
  std::erase_if(grids, [](const RegularGrid& grid) { return !worth_it(grid); });
  return grids;
}

}  // namespace

std::vector<RegularGrid> regular_grids(const PhysicalModel& model) { return Grower(model).all(); }

}  // namespace limber
