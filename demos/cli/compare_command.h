#pragma once

#include "demos/cli/command.h"

namespace limber::demos {

// `limber compare SCENE`: the same scene all-flexible and switching, speed-up and errors.
void add_compare_command(CLI::App& app, Action& chosen);

}  // namespace limber::demos
