#pragma once

#include <iosfwd>

namespace limber::demos {

// The program `limber` without the process around it, so that tests can run it in theirs. Returns
// the exit code: 0 done, 1 the simulation failed, 2 bad usage or bad input (nothing was written).
int cli_main(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace limber::demos
