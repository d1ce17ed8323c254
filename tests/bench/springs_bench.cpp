// The inner loop: springs, dampers, break check, integration.

#include <benchmark/benchmark.h>

#include <cmath>

#include "core/operators/time_operator.h"
#include "core/threads/parallel_for.h"
#include "tests/bench/bench_models.h"

namespace limber {
namespace {

// A gentle vibration, far below the threshold, so that every spring has work to do.
void set_vibrating(Lattice& lattice) {
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    const Vec3& x = lattice.motion[p].position;
    lattice.motion[p].velocity = 1e-3 * Vec3(std::sin(9.0 * x.y()), std::sin(7.0 * x.z()), 0.0);
  }
}

// A cube of N x N x N points with 26 neighbours: damping and break check on.
// `scatter` of rest lengths, a share of them, takes them off the grid.
void springs_of_a_cube(benchmark::State& state, SpringPrecision precision, double scatter = 0.0) {
  constexpr int kSubsteps = 16;
  Lattice lattice;
  PhysicalModel brick = bench::brick(static_cast<int>(state.range(0)), 0.2, Vec3::Zero());
  for (EdgeId e : ids_of(brick.edges)) brick.edges[e].rest_length *= 1.0 + scatter * (e.value % 7);
  add_object(lattice, brick);
  rebuild_active(lattice);
  set_vibrating(lattice);
  TimeOperator time(lattice, Integrator::kSymplecticEuler, precision);
  const double dt = time.largest_step();
  std::uint64_t updates = 0;
  for (auto _ : state) updates += time.advance_springs_only(kSubsteps, dt);
  state.counters["springs"] = static_cast<double>(lattice.active.size());
  state.counters["spring_updates_per_s"] =
      benchmark::Counter(static_cast<double>(updates), benchmark::Counter::kIsRate);
}

void springs_lattice(benchmark::State& state) {
  springs_of_a_cube(state, SpringPrecision::kSingle);
}
BENCHMARK(springs_lattice)->Name("springs/lattice")->Arg(10)->Arg(16)->Arg(22)->Arg(40);

void springs_lattice_threads(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  springs_of_a_cube(state, SpringPrecision::kSingle);
  set_threads(1);
}
BENCHMARK(springs_lattice_threads)
    ->Name("springs/lattice_threads")
    ->ArgsProduct({{16, 40}, {1, 2}})
    ->UseRealTime();

// The same springs without a grid: the general path.
void springs_edges(benchmark::State& state) {
  springs_of_a_cube(state, SpringPrecision::kSingle, 1e-6);
}
BENCHMARK(springs_edges)->Name("springs/edges")->Arg(10)->Arg(16)->Arg(22)->Arg(40);

// The reference: one by one, in double precision.
void springs_double(benchmark::State& state) { springs_of_a_cube(state, SpringPrecision::kDouble); }
BENCHMARK(springs_double)->Name("springs/double")->Arg(10)->Arg(16)->Arg(22)->Arg(40);

}  // namespace
}  // namespace limber
