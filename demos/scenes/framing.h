#pragma once

#include <vector>

#include "core/model/bounds.h"
#include "demos/scenes/scene.h"

namespace limber::demos {

// The camera moved, the way it looks, to where the sphere around the box just fits into the height
// of the picture: `zoom` times as near. What is smaller than 4 cm is seen as if it were that large.
Camera framed(const Camera& camera, const Box3& box, double zoom);

// The box around all points but the outermost 2 % to each side of each axis: what a few chips that
// flew off do not make wider. Empty without points.
Box3 box_of_most(std::vector<Vec3> points);

}  // namespace limber::demos
