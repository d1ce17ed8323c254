// What a resting object costs a game: proxies beside the same bodies in plain Bullet, boxes and
// hulls, kept awake and asleep.

#include <benchmark/benchmark.h>

#include "bullet_bridge/co_simulation.h"
#include "bullet_bridge/conversions.h"
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

enum class Kind { kBox, kHull };
enum class Sleep { kNever, kAllowed };

PhysicalModel object(Kind kind, int i, int count) {
  const Vec3 corner = place_of(i, count) - Vec3::Constant(0.5 * kSide);
  return kind == Kind::kBox ? bench::brick(kPointsAlongEdge, kSide, corner)
                            : bench::tapered_brick(kPointsAlongEdge, kSide, corner);
}

void set_sleeping(btDiscreteDynamicsWorld& world, Sleep sleep) {
  for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
    btCollisionObject& object = *world.getCollisionObjectArray()[i];
    if (object.isStaticObject()) continue;
    object.forceActivationState(sleep == Sleep::kAllowed ? ACTIVE_TAG : DISABLE_DEACTIVATION);
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

// Settles, then measures ticks.
void measure_ticks(benchmark::State& state, bench::BulletWorld& bullet, Sleep sleep) {
  set_sleeping(bullet.world(), sleep);
  for (int n = 0; n < kSettlingTicks; ++n) bullet.tick();
  for (auto _ : state) bullet.tick();
  state.counters["awake"] = awake(bullet.world());
  state.counters["per_object"] = benchmark::Counter(
      static_cast<double>(state.range(0)),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void proxy_idle(benchmark::State& state, Kind kind, Sleep sleep) {
  bench::BulletWorld bullet;
  bullet.add_floor();
  CoSimulation limber(bullet.world());
  const int count = static_cast<int>(state.range(0));
  for (int i = 0; i < count; ++i) limber.add(object(kind, i, count));
  bullet.tick();  // the proxies are there from the first tick on
  const std::size_t switched = limber.switches().size();
  measure_ticks(state, bullet, sleep);
  if (limber.failure()) state.SkipWithError(limber.failure()->text().c_str());
  state.counters["switches"] = static_cast<double>(limber.switches().size() - switched);
}

void bullet_idle(benchmark::State& state, Kind kind, Sleep sleep) {
  bench::BulletWorld models;
  CoSimulation limber(models.world());
  bench::BulletWorld bullet;
  bullet.add_floor();
  const int count = static_cast<int>(state.range(0));
  const auto half = static_cast<btScalar>(0.5 * kSide);
  for (int i = 0; i < count; ++i) {
    if (kind == Kind::kBox) {
      bullet.add_box(kMass, {half, half, half}, to_bullet(place_of(i, count)));
    } else {
      limber.add(object(kind, i, count));
    }
  }
  for (const PieceView& piece : limber.pieces()) bullet.add_twin(*piece.body);
  measure_ticks(state, bullet, sleep);
}

#define IDLE(what, name, ...)                       \
  BENCHMARK_CAPTURE(what##_idle, name, __VA_ARGS__) \
      ->Name(#what "/" #name)                       \
      ->Arg(10)                                     \
      ->Arg(100)                                    \
      ->Arg(1000)                                   \
      ->Unit(benchmark::kMicrosecond)

IDLE(proxy, idle, Kind::kBox, Sleep::kNever);
IDLE(bullet, idle, Kind::kBox, Sleep::kNever);
IDLE(proxy, idle_hull, Kind::kHull, Sleep::kNever);
IDLE(bullet, idle_hull, Kind::kHull, Sleep::kNever);
IDLE(proxy, idle_asleep, Kind::kBox, Sleep::kAllowed);
IDLE(bullet, idle_asleep, Kind::kBox, Sleep::kAllowed);
IDLE(proxy, idle_hull_asleep, Kind::kHull, Sleep::kAllowed);
IDLE(bullet, idle_hull_asleep, Kind::kHull, Sleep::kAllowed);

}  // namespace
}  // namespace limber::bullet
