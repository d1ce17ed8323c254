#pragma once

#include <cstddef>
#include <vector>

#include "demos/scenes/simulation.h"

namespace limber::demos::test {

// One full run of tipsy_teapot, 4 s.
struct TeapotRun {
  RunResult result;
  std::vector<Snapshot::Rigid> boxes;  // as they lie at the end
};

// The k-th run of a method (k shortens the substep as `limber compare --noise` does). A run takes
// up to a minute, so every run is made once a process and shared by all cases that ask for it.
const TeapotRun& teapot_run(Policy policy, std::size_t k = 0);

}  // namespace limber::demos::test
