#pragma once

#include <functional>

#include "demos/cli/command.h"
#include "demos/cli/options.h"

namespace limber::demos {

// Runs a scene as the options say, with a bar of progress on a terminal, until its end or, asked
// after every tick, until `go_on` says no.
RunResult run_with_progress(const SceneOptions& options, const Scene& scene, Terminal& terminal,
                            const std::function<bool()>& go_on = {});

// Tables, JSON and notes of a run, as the options say. Throws SimulationError, after all of them,
// where the scene's behaviour failed.
void report_run(const SceneOptions& options, const Scene& scene, const RunResult& result,
                Terminal& terminal);

}  // namespace limber::demos
