// What a resting object costs a game: a proxy beside a plain Bullet box.

#include <benchmark/benchmark.h>

#include "bullet_bridge/co_simulation.h"
#include "tests/bench/bench_models.h"
#include "tests/bench/bullet_world.h"

namespace limber::bullet {
namespace {

constexpr double kSide = 0.2;        // m
constexpr double kDistance = 0.5;    // m, between neighbours' centres
constexpr double kMass = 16.0;       // kg, 2000 kg/m^3
constexpr int kPointsAlongEdge = 4;  // of a brick
constexpr int kSettlingTicks = 300;  // 5 s: Bullet puts bodies to sleep after 2 s

// Centres in a square on the floor.
Vec3 place_of(int i, int count) {
  const int along = static_cast<int>(std::ceil(std::sqrt(count)));
  return {kDistance * (i % along), 0.5 * kSide, kDistance * (i / along)};
}

void set_sleeping(btDiscreteDynamicsWorld& world, bool allowed) {
  for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
    btCollisionObject& object = *world.getCollisionObjectArray()[i];
    if (!object.isStaticObject()) {
      object.forceActivationState(allowed ? ACTIVE_TAG : DISABLE_DEACTIVATION);
    }
  }
}

int awake(btDiscreteDynamicsWorld& world) {
  int count = 0;
  for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
    const btCollisionObject& object = *world.getCollisionObjectArray()[i];
    count += !object.isStaticObject() && object.isActive();
  }
  return count;
}

// Settles, then measures ticks. Sleeping is off, so that both kinds keep all of their work.
void measure_ticks(benchmark::State& state, bench::BulletWorld& bullet) {
  set_sleeping(bullet.world(), false);
  for (int n = 0; n < kSettlingTicks; ++n) bullet.tick();
  for (auto _ : state) bullet.tick();
  state.counters["awake"] = awake(bullet.world());
  state.counters["per_object"] = benchmark::Counter(
      static_cast<double>(state.range(0)),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void proxy_idle(benchmark::State& state) {
  bench::BulletWorld bullet;
  bullet.add_floor();
  CoSimulation limber(bullet.world());
  const int count = static_cast<int>(state.range(0));
  for (int i = 0; i < count; ++i) {
    const Vec3 corner = place_of(i, count) - Vec3::Constant(0.5 * kSide);
    limber.add(bench::brick(kPointsAlongEdge, kSide, corner));
  }
  bullet.tick();  // the proxies are there from the first tick on
  const std::size_t switched = limber.switches().size();
  measure_ticks(state, bullet);
  if (limber.failure()) state.SkipWithError(limber.failure()->text().c_str());
  state.counters["switches"] = static_cast<double>(limber.switches().size() - switched);
}
BENCHMARK(proxy_idle)->Name("proxy/idle")->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

void bullet_idle(benchmark::State& state) {
  bench::BulletWorld bullet;
  bullet.add_floor();
  const int count = static_cast<int>(state.range(0));
  const auto half = static_cast<btScalar>(0.5 * kSide);
  for (int i = 0; i < count; ++i) {
    const Vec3 at = place_of(i, count);
    bullet.add_box(kMass, {half, half, half},
                   {btScalar(at.x()), btScalar(at.y()), btScalar(at.z())});
  }
  measure_ticks(state, bullet);
}
BENCHMARK(bullet_idle)->Name("bullet/idle")->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace limber::bullet
