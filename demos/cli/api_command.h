#pragma once

#include "demos/cli/command.h"

namespace limber::demos {

// `limber api`: what scripts can use.
void add_api_command(CLI::App& app, Action& chosen);

}  // namespace limber::demos
