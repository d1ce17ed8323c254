#include "core/dynamics/spring_forces.h"

#include <algorithm>

#include "core/dynamics/spring_force.h"
#include "core/threads/parallel_for.h"

namespace limber {
namespace {

// Ranges of parallel loops: some 20 microseconds of work each.
constexpr std::size_t kBlocksPerRange = 128;
constexpr std::size_t kEdgesPerRange = 4096;
constexpr std::size_t kPointsPerRange = 1024;

}  // namespace

void SpringForces::active_changed() {
  stale_ = true;
  if (precision_ == SpringPrecision::kSingle) find_grids();
}

void SpringForces::keep_in_double(std::size_t object) {
  if (object >= in_double_.size()) in_double_.resize(object + 1, false);
  in_double_[object] = true;
  stencils_.clear();
  slot_of_edge_.clear();
  searched_ = 0;
  stale_ = true;
}

void SpringForces::rebuild() {
  stale_ = false;
  if (precision_ == SpringPrecision::kSingle) {
    find_grids();
    for (StencilSprings& stencil : stencils_) stencil.rebuild(lattice_);
    take_edges();
  }
  list_runs();
  for (const StencilSprings& stencil : stencils_) stencil.require_measurable(lattice_);
  edges_.require_measurable(lattice_);
}

// Of the objects that were added since the last time.
void SpringForces::find_grids() {
  slot_of_edge_.resize(lattice_.springs.size());
  for (; searched_ < lattice_.objects.size(); ++searched_) {
    if (is_in_double(searched_)) continue;
    const LatticeObject& object = lattice_.objects[searched_];
    for (const RegularGrid& grid : regular_grids(object.authored)) {
      if (!StencilSprings::can_hold(grid)) continue;
      const auto index = static_cast<std::int32_t>(stencils_.size());
      stencils_.emplace_back(object, grid);
      for (std::size_t s = 0; s < stencils_.back().springs(); ++s) {
        slot_of_edge_[stencils_.back().edge(s)] = {index, static_cast<std::int32_t>(s)};
      }
    }
  }
}

// What is on no grid.
void SpringForces::take_edges() {
  std::vector<std::int32_t> active;
  for (std::size_t i = 0; i < lattice_.active.size(); ++i) {
    const std::int32_t edge = lattice_.active_edge[i];
    if (is_on_grid(edge) || lattice_.breaking.edge_broken[edge]) continue;
    if (is_in_double(lattice_.point_object[lattice_.active[i].a])) continue;
    active.push_back(static_cast<std::int32_t>(i));
  }
  edges_.rebuild(lattice_, active);
}

void SpringForces::list_runs() {
  unbreakable_.clear();
  breakable_.clear();
  append_runs(0, lattice_.first_breakable, unbreakable_);
  append_runs(lattice_.first_breakable, lattice_.active.size(), breakable_);
  scalar_ = 0;
  for (const auto* runs : {&unbreakable_, &breakable_}) {
    for (const Run& run : *runs) scalar_ += run.to - run.from;
  }
}

void SpringForces::append_runs(std::size_t from, std::size_t to, std::vector<Run>& runs) const {
  for (std::size_t i = from; i < to; ++i) {
    if (!is_scalar(lattice_.active_edge[i])) continue;
    if (runs.empty() || runs.back().to != i) runs.push_back({i, i});
    runs.back().to = i + 1;
  }
}

SpringForces::Paths SpringForces::paths() {
  if (stale_) rebuild();
  Paths paths;
  for (std::int32_t e : lattice_.active_edge) {
    if (lattice_.breaking.edge_broken[e]) continue;
    ++(is_scalar(e) ? paths.scalar : is_on_grid(e) ? paths.grids : paths.edges);
  }
  return paths;
}

void SpringForces::remove(std::span<const std::int32_t> broken_edges) {
  if (stale_ || precision_ == SpringPrecision::kDouble) return;
  for (std::int32_t e : broken_edges) {
    edges_.remove(e);
    const Slot slot = slot_of_edge_[e];
    if (slot.stencil >= 0) stencils_[slot.stencil].remove(slot.spring);
  }
}

void SpringForces::add(double dt) {
  if (stale_) rebuild();
  overstretched_.clear();
  for (StencilSprings& stencil : stencils_) add_grid(stencil, dt);
  edges_.add_forces(lattice_, dt, overstretched_);
  add_scalar();
  // A spring of a grid was seen from both ends.
  std::sort(overstretched_.begin(), overstretched_.end());
  const auto last = std::unique(overstretched_.begin(), overstretched_.end());
  overstretched_.erase(last, overstretched_.end());
}

// Runs body(from, to, list) in parallel and gathers what it puts into the lists.
template <class Body>
void SpringForces::collect(std::size_t count, std::size_t grain, const Body& body) {
  overstretched_in_.assign(count / grain + 1, {});
  parallel_for(count, grain, [&](std::size_t from, std::size_t to) {
    body(from, to, overstretched_in_[from / grain]);
  });
  for (auto& list : overstretched_in_) {
    overstretched_.insert(overstretched_.end(), list.begin(), list.end());
    list.clear();
  }
}

void SpringForces::add_grid(StencilSprings& stencil, double dt) {
  stencil.choose_origin(lattice_);
  fastest_in_.assign(stencil.blocks() / kBlocksPerRange + 1, 0.0);
  parallel_for(stencil.blocks(), kBlocksPerRange, [&](std::size_t from, std::size_t to) {
    fastest_in_[from / kBlocksPerRange] = stencil.read_motion(lattice_, from, to);
  });
  const double fastest = *std::max_element(fastest_in_.begin(), fastest_in_.end());
  if (Quanta::may_wrap(fastest, dt)) stencil.require_measurable(lattice_);
  collect(stencil.blocks(), kBlocksPerRange,
          [&](std::size_t from, std::size_t to, std::vector<std::int32_t>& overstretched) {
            stencil.add_forces(lattice_, from, to, overstretched);
          });
}

void SpringForces::add_scalar() {
  const bool in_order = threads() == 1 || scalar_ <= 2 * kEdgesPerRange;
  pulls_.resize(in_order ? 0 : lattice_.active.size());
  for (const Run& run : unbreakable_) {
    in_order ? add_in_order<false>(run) : pull_edges<false>(run);
  }
  for (const Run& run : breakable_) {
    in_order ? add_in_order<true>(run) : pull_edges<true>(run);
  }
  if (!in_order) add_pulls();
}

// The force on the spring's first point, N.
template <bool kMayBreak>
Vec3 SpringForces::pull_of(std::size_t active, std::vector<std::int32_t>& overstretched) const {
  const Spring& s = lattice_.active[active];
  const PointMotion &a = lattice_.motion[s.a], &b = lattice_.motion[s.b];
  const SpringStretch state =
      spring_stretch(b.position - a.position, b.velocity - a.velocity, s.rest_length);
  if constexpr (kMayBreak) {
    if (state.stretch > s.break_threshold || -state.stretch > s.crush_threshold) {
      overstretched.push_back(lattice_.active_edge[active]);
    }
  }
  return spring_tension(s.stiffness, s.damping, state.stretch, state.rate) * state.direction;
}

template <bool kMayBreak>
void SpringForces::add_in_order(const Run& run) {
  for (std::size_t i = run.from; i < run.to; ++i) {
    const Vec3 pull = pull_of<kMayBreak>(i, overstretched_);
    lattice_.force[lattice_.active[i].a] += pull;
    lattice_.force[lattice_.active[i].b] -= pull;
  }
}

template <bool kMayBreak>
void SpringForces::pull_edges(const Run& run) {
  collect(run.to - run.from, kEdgesPerRange,
          [&](std::size_t from, std::size_t to, std::vector<std::int32_t>& overstretched) {
            for (std::size_t i = run.from + from; i < run.from + to; ++i) {
              pulls_[i] = pull_of<kMayBreak>(i, overstretched);
            }
          });
}

// Each point sums its own pulls in the order in which add_in_order() meets them, which gives the
// same bits: the active springs are sorted by edge, those that cannot break first.
void SpringForces::add_pulls() {
  const auto first_breakable = static_cast<std::int32_t>(lattice_.first_breakable);
  const auto add_some = [&](std::int32_t p, bool breakable) {
    for (std::int32_t e : lattice_.point_edges[p]) {
      const std::int32_t i = lattice_.active_of_edge[e];
      if (i < 0 || (i >= first_breakable) != breakable || !is_scalar(e)) continue;
      lattice_.springs[e].a == p ? lattice_.force[p] += pulls_[i] : lattice_.force[p] -= pulls_[i];
    }
  };
  const std::span<const std::int32_t> points = lattice_.dynamic_points;
  parallel_for(points.size(), kPointsPerRange, [&](std::size_t from, std::size_t to) {
    for (std::int32_t p : points.subspan(from, to - from)) {
      if (!unbreakable_.empty()) add_some(p, false);
      if (!breakable_.empty()) add_some(p, true);
    }
  });
}

}  // namespace limber
