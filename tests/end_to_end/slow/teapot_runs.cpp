#include "tests/end_to_end/slow/teapot_runs.h"

#include <cmath>
#include <map>
#include <utility>

#include "demos/cli/comparison.h"

namespace limber::demos::test {
namespace {

// As run(), which does not keep the simulation for a look at the boxes.
TeapotRun run_to_the_end(Policy policy, std::size_t k) {
  const Scene scene = build_scene("tipsy_teapot");
  RunOptions options;
  options.policy = policy;
  options.step_scale = step_scale(k);
  Simulation simulation(scene, options);
  const long ticks = std::lround(scene.seconds / scene.tick);
  for (long n = 0; n < ticks; ++n) simulation.advance_tick();
  return {simulation.result(), simulation.snapshot().rigid};
}

}  // namespace

const TeapotRun& teapot_run(Policy policy, std::size_t k) {
  static std::map<std::pair<Policy, std::size_t>, TeapotRun> runs;
  const auto key = std::pair(policy, k);
  const auto known = runs.find(key);
  if (known != runs.end()) return known->second;
  return runs.emplace(key, run_to_the_end(policy, k)).first->second;
}

}  // namespace limber::demos::test
