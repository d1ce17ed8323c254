#pragma once

#include "tests/contact_scenes/scene.h"

namespace limber::bullet::test {

// m, the deepest place of any flexible body inside a rigid one's true shape or inside another
// flexible one, and of any rigid one inside a flexible one. Flexible bodies are what their
// surfaces, edges without faces and points with edges are, sampled every 2 cm; only solids have an
// inside.
double deepest_penetration(const SceneState& state);

}  // namespace limber::bullet::test
