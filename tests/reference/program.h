#pragma once

#include <iosfwd>

namespace limber::reference {

// The program `limber_reference` without the process around it. Returns the exit code: 0 done, 1
// for an internal error, 2 for bad usage or bad input (nothing was written).
int program(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace limber::reference
