// What it takes to give a piece its collision shape, apart from the rest of the hand-over.

#include <benchmark/benchmark.h>

#include <cmath>

#include "bullet_bridge/proxy_shape.h"
#include "core/model/vec3.h"

namespace limber::bullet {
namespace {

// Points evenly about a ball (golden spiral): none of them is spared by lying inside.
ShapeMaterial ball(std::int64_t count) {
  ShapeMaterial ball;
  ball.volume = 4.18e-3;
  ball.parts = static_cast<std::size_t>(count);
  for (std::int64_t i = 0; i < count; ++i) {
    const double y = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double r = std::sqrt(1.0 - y * y), turn = 2.39996 * static_cast<double>(i);
    ball.points.push_back(0.1 * Vec3(r * std::cos(turn), y, r * std::sin(turn)));
  }
  return ball;
}

void collision_shape(benchmark::State& state) {
  const ShapeMaterial material = ball(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(fit_proxy_shape(material));
}
BENCHMARK(collision_shape)
    ->Name("handover/collision_shape")
    ->Arg(500)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace limber::bullet
