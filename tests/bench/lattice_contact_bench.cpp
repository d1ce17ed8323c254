// What contact costs a lattice of a thousand surface points: a tick in the air, and one at rest on
// a floor, which takes 196 of them; and what threads gain where several lattices lie on it.

#include <benchmark/benchmark.h>

#include "bullet_bridge/co_simulation.h"
#include "core/threads/parallel_for.h"
#include "tests/bench/bench_models.h"
#include "tests/bench/bullet_world.h"

namespace limber::bullet {
namespace {

constexpr int kPointsAlongEdge = 14;  // 2,744 points, 1,016 of them on the surface
constexpr double kSide = 0.5;         // m
constexpr int kSettlingTicks = 30;

void tick(benchmark::State& state, bool on_floor, SpringPrecision precision) {
  bench::BulletWorld bullet;
  if (on_floor) bullet.add_floor();
  CoSimulationSettings settings;
  settings.representation = Representation::kAlwaysFlexible;
  settings.springs = precision;
  CoSimulation limber(bullet.world(), settings);
  limber.add(bench::brick(kPointsAlongEdge, kSide, Vec3(0.0, 1e-3, 0.0)));
  for (int n = 0; n < kSettlingTicks; ++n) bullet.tick();
  for (auto _ : state) bullet.tick();
  if (limber.failure()) state.SkipWithError(limber.failure()->text().c_str());
}
BENCHMARK_CAPTURE(tick, in_the_air_single, false, SpringPrecision::kSingle)
    ->Name("contact/lattice/in_the_air/single")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tick, in_the_air_double, false, SpringPrecision::kDouble)
    ->Name("contact/lattice/in_the_air/double")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tick, on_a_floor_single, true, SpringPrecision::kSingle)
    ->Name("contact/lattice/on_a_floor/single")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tick, on_a_floor_double, true, SpringPrecision::kDouble)
    ->Name("contact/lattice/on_a_floor/double")
    ->Unit(benchmark::kMillisecond);

void several_on_a_floor(benchmark::State& state) {
  constexpr int kPoints = 10;
  set_threads(static_cast<int>(state.range(1)));
  bench::BulletWorld bullet;
  bullet.add_floor();
  CoSimulationSettings settings;
  settings.representation = Representation::kAlwaysFlexible;
  settings.springs = SpringPrecision::kSingle;
  CoSimulation limber(bullet.world(), settings);
  for (int i = 0; i < state.range(0); ++i) {
    limber.add(bench::brick(kPoints, kSide, Vec3(1.5 * kSide * i, 1e-3, 0.0)));
  }
  for (int n = 0; n < kSettlingTicks; ++n) bullet.tick();
  for (auto _ : state) bullet.tick();
  if (limber.failure()) state.SkipWithError(limber.failure()->text().c_str());
  set_threads(1);
}
BENCHMARK(several_on_a_floor)
    ->Name("contact/clusters")
    ->ArgsProduct({{8, 24}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace limber::bullet
