#pragma once

#include <string>
#include <vector>

#include "demos/cli/comparison.h"
#include "demos/scenes/scene.h"
#include "demos/scenes/simulation.h"

// What people read. No speed-up is printed without the softening, the noise floor and the
// baseline's efficiency beside it: alone it says nothing.
namespace limber::demos {

std::string scene_list(const std::vector<SceneEntry>& scenes);
std::string run_report(const RunResult& run, Policy policy);
std::string comparison_report(const ComparedRuns& runs, const Comparison& comparison);

}  // namespace limber::demos
