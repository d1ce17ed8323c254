#include "core/dynamics/edge_springs.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/dynamics/measurable.h"
#include "core/threads/parallel_for.h"

namespace limber {
namespace {

// An object may have edges of very different length; the shortest then lose precision: at this
// spread a quantum is a strain of 1e-6 of theirs.
constexpr double kMostEdgeSpread = 256.0;

// Ranges of parallel loops: some 20 microseconds of work each.
constexpr std::size_t kBatchesPerRange = 128;
constexpr std::size_t kPointsInRange = 1024;

// Not the first point: that may be debris, which flies away. Not that of the first spring, which
// may break: what stays would be rounded differently then. -1: none
std::int32_t first_dynamic_point(const Lattice& lattice, const LatticeObject& object) {
  for (std::int32_t p = object.points.begin; p < object.points.end; ++p) {
    if (lattice.role[p] == PointRole::kDynamic) return p;
  }
  return -1;
}

}  // namespace

void EdgeSprings::rebuild(const Lattice& lattice, const std::vector<std::int32_t>& active) {
  find_frames(lattice, active);
  column_of_.assign(lattice.springs.size(), -1);
  edge_.clear();
  a_.clear(), b_.clear();
  stiffness_.clear(), damping_.clear(), rest_length_.clear(), longest_.clear(), shortest_.clear();
  for (std::int32_t i : active) {
    const Spring& spring = lattice.active[i];
    const Frame& frame = frames_[lattice.point_object[spring.a]];
    if (frame.holds) append(spring, lattice.active_edge[i], frame.quanta);
  }
  list_points(lattice);
  pad();
  pulls_of_ = {};
}

void EdgeSprings::find_frames(const Lattice& lattice, const std::vector<std::int32_t>& active) {
  struct Extremes {
    double shortest = kUnbreakable, longest = 0.0, stiffness = 0.0, damping = 0.0;
  };
  std::vector<Extremes> extremes(lattice.objects.size());
  for (std::int32_t i : active) {
    const Spring& s = lattice.active[i];
    Extremes& e = extremes[lattice.point_object[s.a]];
    e.shortest = std::min(e.shortest, s.rest_length);
    e.longest = std::max(e.longest, s.rest_length);
    e.stiffness = std::max(e.stiffness, s.stiffness);
    e.damping = std::max(e.damping, s.damping);
  }
  frames_.assign(lattice.objects.size(), {});
  for (std::size_t o = 0; o < frames_.size(); ++o) {
    const Extremes& e = extremes[o];
    frames_[o].holds =
        fits_single_precision(e.shortest, e.longest, e.stiffness, e.damping, kMostEdgeSpread);
    if (frames_[o].holds) frames_[o].quanta = Quanta(e.shortest, e.longest);
    frames_[o].origin_point = first_dynamic_point(lattice, lattice.objects[o]);
  }
}

void EdgeSprings::append(const Spring& spring, std::int32_t edge, const Quanta& quanta) {
  column_of_[edge] = static_cast<std::int32_t>(edge_.size());
  edge_.push_back(edge);
  a_.push_back(spring.a);
  b_.push_back(spring.b);
  stiffness_.push_back(static_cast<float>(spring.stiffness));
  damping_.push_back(quanta.damping(spring.damping));
  rest_length_.push_back(quanta.rest_length(spring.rest_length));
  longest_.push_back(quanta.longest(spring.rest_length, spring.break_threshold));
  shortest_.push_back(quanta.shortest(spring.rest_length, spring.crush_threshold));
}

void EdgeSprings::list_points(const Lattice& lattice) {
  packed_.assign(lattice.motion.size(), -1);
  for (std::size_t c = 0; c < a_.size(); ++c) packed_[a_[c]] = packed_[b_[c]] = 0;
  points_.clear();
  for (std::size_t p = 0; p < packed_.size(); ++p) {
    if (packed_[p] < 0) continue;
    packed_[p] = static_cast<std::int32_t>(points_.size());
    points_.push_back(static_cast<std::int32_t>(p));
  }
  for (std::size_t c = 0; c < a_.size(); ++c) {
    a_[c] = packed_[a_[c]];
    b_[c] = packed_[b_[c]];
  }
  motion_.assign(points_.size(), {});
  force_.assign(points_.size(), {});
}

// Springs from a point to itself, without constants, fill the last batch.
void EdgeSprings::pad() {
  const std::size_t batches = (edge_.size() + kEdgeBatch - 1) / kEdgeBatch;
  const std::size_t columns = batches * kEdgeBatch;
  a_.resize(columns, 0);
  b_.resize(columns, 0);
  stiffness_.resize(columns, 0.0f);
  damping_.resize(columns, 0.0f);
  rest_length_.resize(columns, 1.0f);
  longest_.resize(columns, Quanta::kNever);
  shortest_.resize(columns, -Quanta::kNever);
  pulls_.resize(4 * columns);
  flags_.resize(batches);
}

void EdgeSprings::remove(std::int32_t edge) {
  const std::int32_t column = column_of_[edge];
  if (column < 0) return;
  stiffness_[column] = damping_[column] = 0.0f;
  longest_[column] = Quanta::kNever;
  shortest_[column] = -Quanta::kNever;
}

EdgeColumns EdgeSprings::columns() const {
  return {a_.data(),           b_.data(),       stiffness_.data(), damping_.data(),
          rest_length_.data(), longest_.data(), shortest_.data()};
}

void EdgeSprings::read_motion(const Lattice& lattice) {
  for (std::size_t o = 0; o < frames_.size(); ++o) {
    if (frames_[o].origin_point >= 0) frames_[o].origin = lattice.motion[frames_[o].origin_point];
  }
  fastest_.assign(points_.size() / kPointsInRange + 1, 0.0);
  parallel_for(points_.size(), kPointsInRange, [&](std::size_t from, std::size_t to) {
    double fastest = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      const std::int32_t p = points_[i];
      const Frame& frame = frames_[lattice.point_object[p]];
      const Vec3 x = lattice.motion[p].position - frame.origin.position;
      const Vec3 v = lattice.motion[p].velocity - frame.origin.velocity;
      for (int axis = 0; axis < 3; ++axis) {
        motion_[i].position[axis] = frame.quanta.count(x[axis]);
        motion_[i].velocity[axis] = static_cast<float>(v[axis]);
        fastest = std::max(fastest, frame.quanta.speed(std::abs(v[axis])));
      }
    }
    fastest_[from / kPointsInRange] = fastest;
  });
}

const Quanta& EdgeSprings::quanta_of(const Lattice& lattice, std::int32_t edge) const {
  return frames_[lattice.point_object[lattice.springs[edge].a]].quanta;
}

void EdgeSprings::require_measurable(const Lattice& lattice) const {
  for (std::int32_t e : edge_) {
    if (lattice.breaking.edge_broken[e]) continue;
    limber::require_measurable(lattice, e, quanta_of(lattice, e));
  }
}

void EdgeSprings::pull_all() {
  const EdgeColumns edges = columns();
  parallel_for(flags_.size(), kBatchesPerRange, [&](std::size_t from, std::size_t to) {
    for (std::size_t batch = from; batch < to; ++batch) {
      const std::size_t first = batch * kEdgeBatch;
      flags_[batch] = pull_edges(edges, static_cast<std::int32_t>(first), motion_.data(),
                                 pulls_.data() + 4 * first);
    }
  });
}

// The columns at each point, ascending: the order in which scatter_pulls() comes by it.
void EdgeSprings::list_pulls_of_points(const Lattice& lattice) {
  if (pulls_of_.rows() == points_.size()) return;
  pulls_of_ = {};
  pulls_of_.start.push_back(0);
  for (std::int32_t p : points_) {
    const auto first = static_cast<std::ptrdiff_t>(pulls_of_.items.size());
    for (std::int32_t e : lattice.point_edges[p]) {
      if (column_of_[e] < 0) continue;
      pulls_of_.items.push_back(lattice.springs[e].a == p ? column_of_[e] : ~column_of_[e]);
    }
    const auto column = [](std::int32_t item) { return item < 0 ? ~item : item; };
    std::sort(pulls_of_.items.begin() + first, pulls_of_.items.end(),
              [&](std::int32_t i, std::int32_t j) { return column(i) < column(j); });
    pulls_of_.start.push_back(static_cast<std::int32_t>(pulls_of_.items.size()));
  }
}

void EdgeSprings::gather_pulls(std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    PackedForce sum = {};
    for (std::int32_t item : pulls_of_[i]) {
      const float* pull = &pulls_[4 * static_cast<std::size_t>(item < 0 ? ~item : item)];
      for (int axis = 0; axis < 3; ++axis) {
        sum.value[axis] += item < 0 ? -pull[axis] : pull[axis];
      }
    }
    force_[i] = sum;
  }
}

void EdgeSprings::add_forces(Lattice& lattice, double dt,
                             std::vector<std::int32_t>& overstretched_edges) {
  if (edge_.empty()) return;
  read_motion(lattice);
  const double fastest = *std::max_element(fastest_.begin(), fastest_.end());
  if (Quanta::may_wrap(fastest, dt)) require_measurable(lattice);
  pull_all();
  if (threads() > 1 && points_.size() > 2 * kPointsInRange) {
    list_pulls_of_points(lattice);
    parallel_for(points_.size(), kPointsInRange,
                 [&](std::size_t from, std::size_t to) { gather_pulls(from, to); });
  } else {
    std::fill(force_.begin(), force_.end(), PackedForce{});
    for (std::size_t first = 0; first < a_.size(); first += kEdgeBatch) {
      scatter_pulls(columns(), static_cast<std::int32_t>(first), pulls_.data() + 4 * first,
                    force_.data());
    }
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::int32_t p = points_[i];
    const float* f = force_[i].value;
    lattice.force[p] += frames_[lattice.point_object[p]].quanta.quantum() * Vec3(f[0], f[1], f[2]);
  }
  for (std::size_t batch = 0; batch < flags_.size(); ++batch) {
    for (std::uint64_t bits = flags_[batch]; bits != 0; bits &= bits - 1) {
      const std::int32_t e = edge_[batch * kEdgeBatch + std::countr_zero(bits)];
      if (is_overstretched(lattice, e)) {
        overstretched_edges.push_back(e);
      } else {
        limber::require_measurable(lattice, e, quanta_of(lattice, e));
      }
    }
  }
}

}  // namespace limber
