#pragma once

#include "demos/cli/command.h"

namespace limber::demos {

// `limber stability`: where the integrators hold and where they blow up.
void add_stability_command(CLI::App& app, Action& chosen);

}  // namespace limber::demos
