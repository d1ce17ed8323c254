#pragma once

#include <string>

#include "demos/render/pov_scene.h"

// POV-Ray as a separate process: it is licensed and crashes apart from us.
namespace limber::demos {

// Throws InputError with the way to install it where POV-Ray cannot be started.
void require_povray();

// The PNG file, as bytes, of a scene text. Throws SimulationError with the last lines that POV-Ray
// said where it fails.
std::string trace_png(const std::string& pov_text, const PictureSize& size);

}  // namespace limber::demos
