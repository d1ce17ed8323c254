#pragma once

#include "demos/scenes/scene.h"

namespace limber::demos {

// One function a scene, each in a file of its own; scene_library() lists them.
SceneEntry tipsy_teapot();
SceneEntry jelly_and_brick();
SceneEntry leaf_magic();
SceneEntry swing();

// A model from a file falls on the floor. Not in the library: its name is the file's.
SceneEntry drop_of(const std::string& model_file);

}  // namespace limber::demos
