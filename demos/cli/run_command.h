#pragma once

#include "demos/cli/command.h"

namespace limber::demos {

// `limber run [SCENE]`: simulates and reports; without a scene it lists them.
void add_run_command(CLI::App& app, Action& chosen);

}  // namespace limber::demos
