#pragma once

#include "demos/cli/command.h"

namespace limber::demos {

// `limber info FILE`: what is in a model file; checks all of it.
void add_info_command(CLI::App& app, Action& chosen);

}  // namespace limber::demos
