#pragma once

#include "demos/cli/command.h"

namespace limber::demos {

// `limber render SCENE --time S -o IMAGE.png`: one ray-traced picture of a running scene.
void add_render_command(CLI::App& app, Action& chosen);

}  // namespace limber::demos
