#pragma once

#include <vector>

#include "tests/contact_scenes/scene.h"

namespace limber::bullet::test {

// A rigid box of 1e-4 to 1e4 times a cushion's mass on it, and the cushion on such a box.
std::vector<Scene> mass_ratio_scenes();
// Balls at 10, 50 and 200 m/s against pinned sheets, and against a free cube.
std::vector<Scene> ball_scenes();
// A cube between jaws that close and open again.
std::vector<Scene> vice_scenes();
// A lattice on three boxes with friction.
std::vector<Scene> stack_scenes();
// Needles, flexible and rigid, point first.
std::vector<Scene> needle_scenes();
// A rope over beams, a sheet over a sphere.
std::vector<Scene> draping_scenes();
// What is thinner than the lattice's spacing: a rod, a corner.
std::vector<Scene> coarse_scenes();
// A block on shapes of every kind.
std::vector<Scene> landing_scenes();
// Lattice against lattice.
std::vector<Scene> collision_scenes();
// Two hundred bodies of all kinds in an open box for a minute.
std::vector<Scene> crowd_scenes();

std::vector<Scene> all_scenes();

}  // namespace limber::bullet::test
