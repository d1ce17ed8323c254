// What a tick of a scene costs its script: 10,000 calls into the simulator, or none.

#include <benchmark/benchmark.h>

#include <string>

#include "demos/scripting/script_scene.h"

namespace limber::demos {
namespace {

// A ball and a crate in free space, and this body of on_tick(); empty: no script's function at all.
Scene scene_with(const std::string& on_tick) {
  const std::string text =
      "scene{gravity = {0, 0, 0}, floor = false}\n"
      "local ball = rigid.sphere{radius = 0.1, mass = 2, position = {0, 1, 0}}\n"
      "local crate = spawn{position = {0, 3, 0}, model = shape.box{size = {0.2, 0.2, 0.2},\n"
      "  cells = {2, 2, 2}, material = 'spruce'}}\n";
  const SceneEntry entry = script_entry({"bench.lua", text + on_tick, {}}, {});
  return entry.build({});
}

void tick(benchmark::State& state, const std::string& on_tick) {
  Simulation simulation(scene_with(on_tick), {});
  for (auto _ : state) simulation.advance_tick();
}

void ten_thousand(benchmark::State& state, const std::string& call) {
  tick(state, "function on_tick() for i = 1, 10000 do " + call + " end end");
}

BENCHMARK_CAPTURE(tick, without_script, "")->Name("script/none")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(tick, empty, "function on_tick() end")
    ->Name("script/empty_on_tick")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ten_thousand, time, "time()")
    ->Name("script/10000_times_time")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ten_thousand, position, "ball:position()")
    ->Name("script/10000_times_body_position")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ten_thousand, object_position, "crate:position()")
    ->Name("script/10000_times_object_position")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ten_thousand, push, "ball:push{impulse = {0, 0, 0}}")
    ->Name("script/10000_times_push")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ten_thousand, ray, "ray{from = {0, 5, 0}, to = {0, 4, 0}}")
    ->Name("script/10000_times_ray")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace limber::demos
