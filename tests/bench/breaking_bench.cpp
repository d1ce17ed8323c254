// What one broken edge costs: the breaking operator and everything that is kept up to date with it.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
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

void append_points(Lattice& lattice, const GeometricModel& geometry) {
  const std::size_t points = geometry.points.size();
  for (const Vec3& at : geometry.points) lattice.motion.push_back({at, Vec3::Zero()});
  lattice.authored_position = geometry.points.raw();
  lattice.mass.assign(points, 1e-3);
  lattice.inverse_mass.assign(points, 1e3);
  lattice.role.assign(points, PointRole::kDynamic);
  lattice.contact_radius.assign(points, 0.45 * kSpacing);
  lattice.point_object.assign(points, 0);
}

void append_springs(Lattice& lattice, const GeometricModel& geometry) {
  for (const Edge& edge : geometry.edges) {
    Spring spring{};
    spring.a = edge.a.value;
    spring.b = edge.b.value;
    spring.rest_length = kSpacing;
    lattice.springs.push_back(spring);
  }
}

void link_points(Lattice& lattice) {
  std::vector<std::vector<std::array<std::int32_t, 2>>> links(lattice.motion.size());
  for (std::size_t e = 0; e < lattice.springs.size(); ++e) {
    const auto edge = static_cast<std::int32_t>(e);
    const Spring& spring = lattice.springs[e];
    links[spring.a].push_back({edge, spring.b});
    links[spring.b].push_back({edge, spring.a});
  }
  lattice.point_edges.start.push_back(0);
  for (const auto& of_point : links) {
    for (const auto& [edge, neighbour] : of_point) {
      lattice.point_edges.items.push_back(edge);
      lattice.point_neighbours.push_back(neighbour);
    }
    lattice.point_edges.start.push_back(
        static_cast<std::int32_t>(lattice.point_edges.items.size()));
  }
}

// A cube of cells with their axial edges, compiled by hand: add_object() would find its stable step
// first, which takes minutes for a million points.
Lattice cube(int points_along) {
  const int cells = points_along - 1;
  PhysicalModel model = with_default_attributes(
      box_lattice({cells, cells, cells}, Vec3::Constant(kSpacing), Vec3::Zero(), "cube",
                  {.face_diagonals = false, .body_diagonals = false}),
      "cube");
  Lattice lattice;
  lattice.topology = breaking_topology(model.geometry);
  lattice.breaking = breaking_state(model, lattice.topology);
  append_points(lattice, model.geometry);
  append_springs(lattice, model.geometry);
  link_points(lattice);
  lattice.objects.emplace_back();
  lattice.objects[0].contact_frequency = 1e3;
  rebuild_active(lattice);
  return lattice;
}

std::unique_ptr<Body> body(int points_along) {
  auto made = std::make_unique<Body>();
  made->lattice = cube(points_along);
  Tracked& intact = made->intact;
  intact.breaking = made->lattice.breaking;
  intact.pieces.reset(made->lattice);
  intact.boundary.reset(made->lattice.breaking);
  intact.contacts.refresh(made->lattice, intact.pieces.components(), true, false);
  made->now = intact;
  return made;
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

void one_edge(benchmark::State& state) {
  const int along = static_cast<int>(std::lround(std::cbrt(static_cast<double>(state.range(0)))));
  const std::unique_ptr<Body> broken = body(along);
  const std::vector<std::int32_t> edges = scattered_edges(broken->lattice, along);
  BreakingResult result;
  std::vector<double> seconds;
  std::size_t next = 0;
  for (auto _ : state) {
    if (next == edges.size()) {
      restore(*broken);
      next = 0;
    }
    const auto start = std::chrono::steady_clock::now();
    break_one(*broken, edges[next++], result);
    const auto end = std::chrono::steady_clock::now();
    seconds.push_back(std::chrono::duration<double>(end - start).count());
    state.SetIterationTime(seconds.back());
  }
  // Beside the mean, which a page fault or another process spoils.
  std::nth_element(seconds.begin(), seconds.begin() + std::ssize(seconds) / 2, seconds.end());
  state.counters["median_us"] = 1e6 * seconds[seconds.size() / 2];
  state.counters["points"] = static_cast<double>(broken->lattice.motion.size());
}
// Both do the same work: 1 edge, 4 cells, 32 faces. What differs is where the data are: the small
// cube stays in the first two caches, of the large one (over 1 GB) nearly every line comes from
// memory. As many iterations as the large one has edges for.
BENCHMARK(one_edge)
    ->Name("breaking/one_edge")
    ->Arg(1000)
    ->Arg(1000000)
    ->UseManualTime()
    ->Iterations(12000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace limber
