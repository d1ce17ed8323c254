#pragma once

#include <string>

#include "demos/scenes/simulation.h"

namespace limber::demos {

struct PictureSize {
  int width = 960;   // pixels
  int height = 600;  // pixels
};

// A snapshot as the text of a POV-Ray 3.7 scene: its bodies and boxes on a chequered floor under a
// soft light. POV-Ray's space is left-handed and ours is not; the camera's `right` vector points
// the other way round, which mirrors the picture back. Nothing is mirrored in the coordinates.
std::string pov_scene(const Snapshot& snapshot, const PictureSize& size);

}  // namespace limber::demos
