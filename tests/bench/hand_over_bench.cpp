// One change of representation, with the books it keeps.

#include <benchmark/benchmark.h>

#include "bullet_bridge/co_simulation.h"
#include "bullet_bridge/hand_over.h"
#include "core/operators/time_operator.h"
#include "tests/bench/bench_models.h"
#include "tests/bench/bullet_world.h"

namespace limber::bullet {
namespace {

Lattice spinning_brick(std::int64_t points) {
  // The cube nearest to the wanted number of points.
  const int along = static_cast<int>(std::lround(std::cbrt(static_cast<double>(points))));
  PhysicalModel model = bench::brick(along, 0.2, Vec3::Zero());
  set_in_motion(model, {1.0, 2.0, 3.0}, {0.5, -1.0, 2.0});
  Lattice lattice;
  add_object(lattice, std::move(model));
  rebuild_active(lattice);
  return lattice;
}

void to_rigid(benchmark::State& state) {
  bench::BulletWorld bullet;
  const Lattice lattice = spinning_brick(state.range(0));
  for (auto _ : state) {
    std::unique_ptr<RigidProxy> proxy;
    benchmark::DoNotOptimize(freeze(bullet.world(), lattice, lattice.dynamic_points, proxy));
    state.PauseTiming();  // taking the proxy out of the world belongs to the other direction
    proxy.reset();
    state.ResumeTiming();
  }
  state.counters["points"] = static_cast<double>(lattice.motion.size());
}
BENCHMARK(to_rigid)->Name("handover/to_rigid")->Arg(1000)->Unit(benchmark::kMicrosecond);

// What a body takes over from its lattice, with the books, without its collision shape.
void state_alone(benchmark::State& state) {
  const Lattice lattice = spinning_brick(state.range(0));
  for (auto _ : state) {
    HandOver books;
    benchmark::DoNotOptimize(take_state(lattice, lattice.dynamic_points, books));
  }
  state.counters["points"] = static_cast<double>(lattice.motion.size());
}
BENCHMARK(state_alone)->Name("handover/state")->Arg(1000)->Unit(benchmark::kMicrosecond);

void to_flexible(benchmark::State& state) {
  bench::BulletWorld bullet;
  Lattice lattice = spinning_brick(state.range(0));
  std::unique_ptr<RigidProxy> proxy;
  freeze(bullet.world(), lattice, lattice.dynamic_points, proxy);
  for (auto _ : state) benchmark::DoNotOptimize(thaw(lattice, lattice.dynamic_points, *proxy));
  state.counters["points"] = static_cast<double>(lattice.motion.size());
}
BENCHMARK(to_flexible)->Name("handover/to_flexible")->Arg(1000)->Unit(benchmark::kMicrosecond);

// What they are compared with: one substep of the same lattice, springs and integration alone.
void one_substep(benchmark::State& state) {
  Lattice lattice = spinning_brick(state.range(0));
  TimeOperator time_operator(lattice, Integrator::kSymplecticEuler, kWorldSprings);
  const double dt = time_operator.largest_step();
  for (auto _ : state) benchmark::DoNotOptimize(time_operator.advance_springs_only(100, dt));
  state.counters["per_substep"] = benchmark::Counter(
      100.0, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(one_substep)->Name("handover/100_substeps")->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace limber::bullet
