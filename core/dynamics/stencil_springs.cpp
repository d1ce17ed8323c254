#include "core/dynamics/stencil_springs.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/measurable.h"

namespace limber {
namespace {

double shortest_rest_length(const RegularGrid& grid) {
  double shortest = kUnbreakable;
  for (double rest : grid.rest_length) {
    if (rest > 0.0) shortest = std::min(shortest, rest);
  }
  return shortest;
}

double longest_rest_length(const RegularGrid& grid) {
  return *std::max_element(grid.rest_length.begin(), grid.rest_length.end());
}

// Cells of a box may be long and thin, but not needles.
constexpr double kMostSpread = 16.0;

}  // namespace

bool StencilSprings::can_hold(const RegularGrid& grid) {
  double stiffness = 0.0, damping = 0.0;
  for (const auto& classes : grid.classes) {
    for (const SpringClass& c : classes) {
      stiffness = std::max(stiffness, c.stiffness);
      damping = std::max(damping, c.damping);
    }
  }
  return fits_single_precision(shortest_rest_length(grid), longest_rest_length(grid), stiffness,
                               damping, kMostSpread);
}

StencilSprings::StencilSprings(const LatticeObject& object, const RegularGrid& grid)
    : quanta_(shortest_rest_length(grid), longest_rest_length(grid)), point_(grid.point) {
  for (std::int32_t& p : point_) {
    if (p >= 0) p += object.points.begin;
  }
  for (const GridSpring& s : grid.springs) {
    springs_.push_back({object.edges.begin + s.edge.value, s.cell, s.half,
                        static_cast<std::uint8_t>(s.spring_class + 1)});
  }
  set_constants(grid);
  // One step along every axis, and what is left of the last block.
  guard_ = 1 + grid.size[0] * (1 + grid.size[1]) + kStencilBlock;
  const std::size_t cells = point_.size() + 2 * std::size_t(guard_);
  for (auto& array : position_) array.assign(cells, 0);
  for (auto& array : velocity_) array.assign(cells, 0.0f);
  for (auto& array : force_) array.assign(cells, 0.0f);
  for (auto& array : classes_) array.assign(cells, 0);
}

void StencilSprings::set_constants(const RegularGrid& grid) {
  for (int d = 0; d < kGridDirections; ++d) {
    StencilConstants& to = constants_[d];
    const GridStep& step = kGridSteps[d];
    const double rest = grid.rest_length[d];
    to.offset = step[0] + grid.size[0] * (step[1] + grid.size[1] * step[2]);
    to.rest_length = quanta_.rest_length(rest);
    to.longest.fill(Quanta::kNever);
    to.shortest.fill(-Quanta::kNever);
    for (std::size_t c = 0; c < grid.classes[d].size(); ++c) {
      const SpringClass& from = grid.classes[d][c];
      to.stiffness[c + 1] = static_cast<float>(from.stiffness);
      to.damping[c + 1] = quanta_.damping(from.damping);
      to.longest[c + 1] = quanta_.longest(rest, from.break_threshold);
      to.shortest[c + 1] = quanta_.shortest(rest, from.crush_threshold);
      crush_ = crush_ || to.shortest[c + 1] > -Quanta::kNever;
    }
  }
}

void StencilSprings::set_class(std::int32_t cell, int half, std::uint32_t number) {
  std::uint32_t& word = classes_[half / 8][guard_ + cell];
  const int shift = 4 * (half % 8);
  word = (word & ~(15u << shift)) | number << shift;
}

std::int32_t StencilSprings::other_cell(const Spring& spring) const {
  const std::int32_t offset = constants_[spring.half / 2].offset;
  return spring.half % 2 == 0 ? spring.cell + offset : spring.cell - offset;
}

void StencilSprings::remove(std::size_t spring) {
  const Spring& s = springs_[spring];
  set_class(s.cell, s.half, 0);
  set_class(other_cell(s), s.half ^ 1, 0);
}

void StencilSprings::rebuild(const Lattice& lattice) {
  // Neither debris, which flies away, nor of a spring, which may break: rounding would change then.
  const auto dynamic = [&](std::int32_t p) {
    return p >= 0 && lattice.role[p] == PointRole::kDynamic;
  };
  const auto first = std::find_if(point_.begin(), point_.end(), dynamic);
  origin_point_ = first == point_.end() ? -1 : *first;
  for (auto& array : classes_) std::fill(array.begin(), array.end(), 0);
  std::vector<bool> busy((point_.size() + kStencilBlock - 1) / kStencilBlock, false);
  for (const Spring& s : springs_) {
    if (lattice.active_of_edge[s.edge] < 0 || lattice.breaking.edge_broken[s.edge]) continue;
    const std::int32_t other = other_cell(s);
    set_class(s.cell, s.half, s.number);
    set_class(other, s.half ^ 1, s.number);
    busy[s.cell / kStencilBlock] = busy[other / kStencilBlock] = true;
  }
  blocks_.clear();
  for (std::size_t b = 0; b < busy.size(); ++b) {
    if (busy[b]) blocks_.push_back(static_cast<std::int32_t>(guard_ + b * kStencilBlock));
  }
  overstretched_.assign(blocks_.size(), 0);
}

void StencilSprings::choose_origin(const Lattice& lattice) {
  if (origin_point_ >= 0) origin_ = lattice.motion[origin_point_];
}

// body(block, cell, point) for every point in these blocks.
template <class Body>
void StencilSprings::for_each_point(std::size_t from, std::size_t to, const Body& body) const {
  const std::int32_t end = guard_ + static_cast<std::int32_t>(point_.size());
  for (std::size_t b = from; b < to; ++b) {
    const std::int32_t last = std::min(blocks_[b] + kStencilBlock, end);
    for (std::int32_t cell = blocks_[b]; cell < last; ++cell) {
      if (point_[cell - guard_] >= 0) body(b, cell, point_[cell - guard_]);
    }
  }
}

double StencilSprings::read_motion(const Lattice& lattice, std::size_t from, std::size_t to) {
  double fastest = 0.0;  // m/s
  for_each_point(from, to, [&](std::size_t, std::int32_t cell, std::int32_t p) {
    if (lattice.role[p] != PointRole::kDynamic) return;
    const PointMotion& motion = lattice.motion[p];
    for (int axis = 0; axis < 3; ++axis) {
      position_[axis][cell] = quanta_.count(motion.position[axis] - origin_.position[axis]);
      const double velocity = motion.velocity[axis] - origin_.velocity[axis];
      velocity_[axis][cell] = static_cast<float>(velocity);
      fastest = std::max(fastest, std::abs(velocity));
    }
  });
  return quanta_.speed(fastest);
}

void StencilSprings::require_measurable(const Lattice& lattice) const {
  for (const Spring& s : springs_) {
    if (lattice.active_of_edge[s.edge] < 0 || lattice.breaking.edge_broken[s.edge]) continue;
    limber::require_measurable(lattice, s.edge, quanta_);
  }
}

// They are in the order of their edges.
bool StencilSprings::has(std::int32_t edge) const {
  const auto found = std::lower_bound(springs_.begin(), springs_.end(), edge,
                                      [](const Spring& s, std::int32_t e) { return s.edge < e; });
  return found != springs_.end() && found->edge == edge;
}

void StencilSprings::look_at(const Lattice& lattice, std::int32_t point,
                             std::vector<std::int32_t>& overstretched_edges) const {
  for (std::int32_t e : lattice.point_edges[point]) {
    if (lattice.active_of_edge[e] < 0 || lattice.breaking.edge_broken[e]) continue;
    // Flags go by the weakest spring of a class: those of a strong piece with weak seams come in
    // every substep, and find nothing.
    const bool overstretched = is_overstretched(lattice, e);
    if (!overstretched && length_of(lattice, e) <= quanta_.longest_measurable()) continue;
    if (!has(e)) continue;
    if (overstretched) {
      overstretched_edges.push_back(e);
    } else {
      limber::require_measurable(lattice, e, quanta_);
    }
  }
}

StencilView StencilSprings::view() {
  StencilView view;
  for (int axis = 0; axis < 3; ++axis) {
    view.position[axis] = position_[axis].data();
    view.velocity[axis] = velocity_[axis].data();
    view.force[axis] = force_[axis].data();
  }
  for (int word = 0; word < 4; ++word) view.classes[word] = classes_[word].data();
  view.constants = constants_.data();
  view.quantum = static_cast<float>(quanta_.quantum());
  view.crush = crush_;
  return view;
}

void StencilSprings::add_forces(Lattice& lattice, std::size_t from, std::size_t to,
                                std::vector<std::int32_t>& overstretched_edges) {
  sum_stencil_forces(view(), std::span(blocks_).subspan(from, to - from),
                     std::span(overstretched_).subspan(from, to - from));
  for_each_point(from, to, [&](std::size_t block, std::int32_t cell, std::int32_t p) {
    lattice.force[p] += Vec3(force_[0][cell], force_[1][cell], force_[2][cell]);
    const bool flagged = overstretched_[block] >> (cell - blocks_[block]) & 1;
    if (flagged) look_at(lattice, p, overstretched_edges);
  });
}

}  // namespace limber
