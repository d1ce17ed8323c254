// The inner loop: springs, dampers, break check, integration.

#include <benchmark/benchmark.h>

#include <cmath>

#include "core/operators/time_operator.h"
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

void springs_edges(benchmark::State& state) {
  constexpr int kSubsteps = 16;
  Lattice lattice;
  add_object(lattice, bench::brick(static_cast<int>(state.range(0)), 0.2, Vec3::Zero()));
  rebuild_active(lattice);
  set_vibrating(lattice);
  TimeOperator time(lattice);
  const double dt = time.largest_step();
  std::uint64_t updates = 0;
  for (auto _ : state) updates += time.advance_springs_only(kSubsteps, dt);
  state.counters["springs"] = static_cast<double>(lattice.active.size());
  state.counters["spring_updates_per_s"] =
      benchmark::Counter(static_cast<double>(updates), benchmark::Counter::kIsRate);
}
BENCHMARK(springs_edges)->Name("springs/edges")->Arg(10)->Arg(16)->Arg(22);

}  // namespace
}  // namespace limber
