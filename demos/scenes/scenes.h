#pragma once

#include "demos/scenes/scene.h"

namespace limber::demos {

// One function a scene, each in a file of its own; scene_library() lists them.
SceneEntry tipsy_teapot();
SceneEntry jelly_and_brick();

}  // namespace limber::demos
