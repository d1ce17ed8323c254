#pragma once

#include "demos/cli/command.h"
#include "demos/cli/options.h"

namespace limber::demos {

// `limber run --watch`: runs a scene from a file, reports, and runs it again whenever the file or
// one that its script reads was saved, also in the middle of a run. What is wrong with the scene is
// said and waits to be mended. Ends at Ctrl-C, with the report of what ran until then. Throws
// InputError, before anything runs, for a scene that is no file.
void watch_scene(const SceneOptions& options, Terminal& terminal);

}  // namespace limber::demos
