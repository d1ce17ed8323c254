// What one broken edge costs: the breaking operator and everything that is kept up to date with it.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <random>

#include "core/contact/point_contacts.h"
#include "core/dynamics/component_tracker.h"
#include "core/modeller/box_lattice.h"
#include "core/operators/boundary_tracker.h"

namespace limber {
namespace {

constexpr double kSpacing = 0.01;  // m

// What breaking changes.
struct Tracked {
  BreakingState breaking;
  ComponentTracker pieces;
  BoundaryTracker boundary;
  PointContacts contacts;
};

struct Body {
  Lattice lattice;
  Tracked intact;
  Tracked now;
};

// A cube of cells with their axial edges.
Lattice cube(int points_along) {
  const int cells = points_along - 1;
  PhysicalModel model = with_default_attributes(
      box_lattice({cells, cells, cells}, Vec3::Constant(kSpacing), Vec3::Zero(), "cube",
                  {.face_diagonals = false, .body_diagonals = false}),
      "cube");
  for (PointAttributes& point : model.points) point.mass = 1e-3;  // kg
  for (EdgeAttributes& edge : model.edges) edge.stiffness = 1e3;  // N/m
  Lattice lattice;
  add_object(lattice, std::move(model));
  rebuild_active(lattice);
  return lattice;
}

// Made once: a million points take half a minute.
Body& body(int points_along) {
  static std::map<int, std::unique_ptr<Body>> bodies;
  std::unique_ptr<Body>& made = bodies[points_along];
  if (made) return *made;
  made = std::make_unique<Body>();
  made->lattice = cube(points_along);
  Tracked& intact = made->intact;
  intact.breaking = made->lattice.breaking;
  intact.pieces.reset(made->lattice);
  intact.boundary.reset(made->lattice.breaking);
  intact.contacts.refresh(made->lattice, intact.pieces.components(), true, false);
  made->now = intact;
  return *made;
}

std::int32_t edge_between(const Lattice& lattice, std::int32_t p, std::int32_t q) {
  const auto edges = lattice.point_edges[p];
  const std::int32_t* neighbours = &lattice.point_neighbours[lattice.point_edges.start[p]];
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (neighbours[i] == q) return edges[i];
  return -1;
}

// Every fourth edge along x in the interior, in random order: no break touches a cell that another
// has touched, and hardly any a cache line.
std::vector<std::int32_t> scattered_edges(const Lattice& lattice, int points_along) {
  std::vector<std::int32_t> edges;
  for (int z = 2; z + 2 < points_along; z += 4)
    for (int y = 2; y + 2 < points_along; y += 4)
      for (int x = 2; x + 3 < points_along; x += 4) {
        const std::int32_t p = x + points_along * (y + points_along * z);
        edges.push_back(edge_between(lattice, p, p + 1));
      }
  std::mt19937 random(7);
  for (std::size_t i = edges.size(); i > 1; --i) std::swap(edges[i - 1], edges[random() % i]);
  return edges;
}

void break_one(Body& body, std::int32_t edge, BreakingResult& result) {
  Lattice& lattice = body.lattice;
  break_edges(lattice.topology, lattice.breaking, {&edge, 1}, result);
  benchmark::DoNotOptimize(body.now.pieces.edges_broken(lattice, result.broken_edges));
  body.now.boundary.update(lattice.topology, result);
  body.now.contacts.edges_broken(lattice, result.broken_edges);
}

void restore(Body& body) {
  body.lattice.breaking = body.intact.breaking;
  body.now = body.intact;
}

// Reads more than the caches hold.
void flush_caches() {
  static const std::vector<std::uint64_t> much(std::size_t{1} << 24, 1);  // 128 MB
  benchmark::DoNotOptimize(std::accumulate(much.begin(), much.end(), std::uint64_t{0}));
}

enum class Caches { kOfLastBreak, kFlushed };

void one_edge(benchmark::State& state, Caches caches) {
  const int along = static_cast<int>(std::lround(std::cbrt(static_cast<double>(state.range(0)))));
  Body& broken = body(along);
  restore(broken);
  const std::vector<std::int32_t> edges = scattered_edges(broken.lattice, along);
  BreakingResult result;
  std::vector<double> seconds;
  std::size_t next = 0;
  for (auto _ : state) {
    if (next == edges.size()) {
      restore(broken);
      next = 0;
    }
    if (caches == Caches::kFlushed) flush_caches();
    const auto start = std::chrono::steady_clock::now();
    break_one(broken, edges[next++], result);
    const auto end = std::chrono::steady_clock::now();
    seconds.push_back(std::chrono::duration<double>(end - start).count());
    state.SetIterationTime(seconds.back());
  }
  // Beside the mean, which a page fault or another process spoils.
  std::nth_element(seconds.begin(), seconds.begin() + std::ssize(seconds) / 2, seconds.end());
  state.counters["median_us"] = 1e6 * seconds[seconds.size() / 2];
  state.counters["points"] = static_cast<double>(broken.lattice.motion.size());
}
// All do the same work: 1 edge, 4 cells, 32 faces. What differs is where the data are. Scattered:
// the small cube stays in the first two caches, of the large one (over 1 GB) nearly every line
// comes from memory, and its page's address too. As many iterations as the large one has
// edges for.
BENCHMARK_CAPTURE(one_edge, scattered, Caches::kOfLastBreak)
    ->Name("breaking/one_edge/scattered")
    ->Arg(1000)
    ->Arg(1000000)
    ->UseManualTime()
    ->Iterations(12000)
    ->Unit(benchmark::kMicrosecond);
// Flushed before every break, as by the springs of other objects: neither cube is in the caches.
BENCHMARK_CAPTURE(one_edge, flushed, Caches::kFlushed)
    ->Name("breaking/one_edge/flushed")
    ->Arg(1000)
    ->Arg(1000000)
    ->UseManualTime()
    ->Iterations(500)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace limber
