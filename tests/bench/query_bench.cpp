// What it costs a game to look at a flexible piece: rays at a brick of N x N x N points.

#include <benchmark/benchmark.h>

#include "bullet_bridge/co_simulation.h"
#include "tests/bench/bench_models.h"
#include "tests/bench/bullet_world.h"

namespace limber::bullet {
namespace {

constexpr double kSide = 1.0;  // m

struct Scene {
  bench::BulletWorld bullet;
  CoSimulation limber;

  explicit Scene(int points_along_edge)
      : limber(bullet.world(), {.representation = Representation::kAlwaysFlexible}) {
    bullet.world().setGravity(btVector3(0, 0, 0));
    limber.add(bench::brick(points_along_edge, kSide, Vec3::Constant(-0.5 * kSide)));
  }

  bool ray(double x) {
    const btVector3 from(static_cast<btScalar>(x), 2, btScalar(0.1));
    const btVector3 to(static_cast<btScalar>(x), -2, btScalar(0.1));
    btCollisionWorld::ClosestRayResultCallback hit(from, to);
    bullet.world().rayTest(from, to, hit);
    return hit.hasHit();
  }
};

void count_faces(benchmark::State& state, const CoSimulation& limber) {
  state.counters["faces"] = static_cast<double>(limber.surface(0).triangles.size());
}

// The first one in a tick gathers the faces.
void first_ray(benchmark::State& state) {
  Scene scene(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    state.PauseTiming();
    scene.bullet.tick();
    state.ResumeTiming();
    benchmark::DoNotOptimize(scene.ray(0.2));
  }
  count_faces(state, scene.limber);
}
BENCHMARK(first_ray)->Name("query/first_ray")->Arg(10)->Arg(30)->Unit(benchmark::kMicrosecond);

void ray(benchmark::State& state) {
  Scene scene(static_cast<int>(state.range(0)));
  double x = -0.4;
  for (auto _ : state) {
    benchmark::DoNotOptimize(scene.ray(x));
    x = x > 0.4 ? -0.4 : x + 0.0371;
  }
  count_faces(state, scene.limber);
}
BENCHMARK(ray)->Name("query/ray")->Arg(10)->Arg(30)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace limber::bullet
