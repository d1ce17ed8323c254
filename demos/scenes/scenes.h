#pragma once

#include "demos/scenes/scene.h"

namespace limber::demos {

// A model from a file falls on the floor. Not in the library: its name is the file's.
SceneEntry drop_of(const std::string& model_file);

}  // namespace limber::demos
