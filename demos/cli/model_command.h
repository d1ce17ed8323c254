#pragma once

#include "demos/cli/command.h"

namespace limber::demos {

// `limber model MESH`: a lattice of a material from a triangle mesh, and how well it stands for it.
void add_model_command(CLI::App& app, Action& chosen);

}  // namespace limber::demos
