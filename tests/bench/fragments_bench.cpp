// A brick that bursts into cubes above a floor, and what the cubes cost once they lie there, beside
// the same bodies in plain Bullet.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "bullet_bridge/co_simulation.h"
#include "tests/bench/bullet_world.h"
#include "tests/support/bursting_brick.h"

namespace limber::bullet {
namespace {

constexpr double kTick = 1.0 / 60.0;  // s
constexpr int kFlightTicks = 10;      // the lowest reach the floor after that
constexpr int kLandingTicks = 90;
constexpr int kSettlingTicks = 600;

// The cube nearest to the wanted number of fragments, 0.3 m above the floor.
struct Burst {
  bench::BulletWorld bullet;
  CoSimulation limber{bullet.world()};

  explicit Burst(std::int64_t fragments) {
    const int along = static_cast<int>(std::lround(std::cbrt(static_cast<double>(fragments))));
    bullet.add_floor();
    limber.add(bursting_brick(along, {0.0, 0.3 + 0.05 * along, 0.0}));
  }

  double flexible() const {
    const std::vector<PieceView> pieces = limber.pieces();
    return static_cast<double>(
        std::count_if(pieces.begin(), pieces.end(), [](const auto& p) { return p.flexible; }));
  }
};

// CPU time: what else the machine does would count as slow ticks.
double timed_tick(bench::BulletWorld& bullet) {
  const std::clock_t begin = std::clock();
  bullet.tick();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// From the burst on: into the air alone, and with the landing.
void burst(benchmark::State& state, int ticks) {
  double slow = 0.0, worst = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    Burst scene(state.range(0));
    slow = worst = 0.0;
    state.ResumeTiming();
    for (int n = 0; n < ticks; ++n) {
      const double spent = timed_tick(scene.bullet);
      slow += spent > kTick;
      worst = std::max(worst, spent);
    }
    state.PauseTiming();
    if (scene.limber.failure()) state.SkipWithError(scene.limber.failure()->text().c_str());
    state.counters["pieces"] = static_cast<double>(scene.limber.pieces().size());
    state.counters["flexible"] = scene.flexible();
    state.ResumeTiming();
  }
  state.counters["ticks"] = ticks;
  state.counters["below_real_time"] = slow;
  state.counters["worst_ms"] = 1e3 * worst;
}
BENCHMARK_CAPTURE(burst, flight, kFlightTicks)
    ->Name("fragments/burst")
    ->Arg(125)
    ->Arg(1000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(burst, landing, kLandingTicks)
    ->Name("fragments/burst_and_landing")
    ->Arg(125)
    ->Arg(1000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

double awake(btDiscreteDynamicsWorld& world) {
  double count = 0;
  for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
    const btCollisionObject& object = *world.getCollisionObjectArray()[i];
    count += !object.isStaticObject() && object.isActive();
  }
  return count;
}

void fragments_at_rest(benchmark::State& state) {
  Burst scene(state.range(0));
  for (int n = 0; n < kSettlingTicks; ++n) scene.bullet.tick();
  for (auto _ : state) scene.bullet.tick();
  state.counters["awake"] = awake(scene.bullet.world());
  state.counters["flexible"] = scene.flexible();
}
BENCHMARK(fragments_at_rest)
    ->Name("fragments/at_rest")
    ->Arg(125)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);

// The same shapes in the same places, without Limber.
void bodies_at_rest(benchmark::State& state) {
  Burst scene(state.range(0));
  for (int n = 0; n < kSettlingTicks; ++n) scene.bullet.tick();
  bench::BulletWorld plain;
  plain.add_floor();
  for (const PieceView& piece : scene.limber.pieces()) {
    if (!piece.flexible) plain.add_twin(*piece.body);
  }
  for (int n = 0; n < kSettlingTicks / 2; ++n) plain.tick();
  for (auto _ : state) plain.tick();
  state.counters["awake"] = awake(plain.world());
}
BENCHMARK(bodies_at_rest)
    ->Name("bullet/fragments_at_rest")
    ->Arg(125)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace limber::bullet
